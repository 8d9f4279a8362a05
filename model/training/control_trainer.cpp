#include <torch/torch.h>

#include <cmath>

#include "model/controllers/checkpoint.h"
#include "model/core/error.h"
#include "model/flow/checkpoint.h"
#include "model/motion/velocity_factors.h"
#include "model/training/control_clips.h"
#include "model/training/control_losses.h"
#include "model/training/trainer.h"
#include "model/training/training_run.h"

namespace choreo {
namespace {

constexpr int kNormalisationWindows = 512;
constexpr int kControlValidationWindows = 48;
constexpr double kTruthDecay = 0.998;  // of scheduled sampling's probability, a step
constexpr double kCurriculum = 0.3;    // share of a stage after which all lengths are drawn
constexpr double kLongest = 0.25;      // share of draws among all lengths alike

ControllersConfig ConfigOf(const TrainOptions& options) {
  ControllersConfig config;
  if (!options.name.empty()) config.name = options.name;
  config.two_lstms = !options.controllers.one_lstm;
  config.transformers = !options.controllers.condition_fc;
  config.root_decoder = !options.controllers.one_decoder;
  config.velocity_factors = !options.controllers.no_velocity_factors;
  config.key_loss = !options.no_key_loss;
  return config;
}

class ControlRun : public TrainingRun {
 public:
  ControlRun(const TrainOptions& options, const TrainingClips& clips)
      : TrainingRun(options, clips),
        train_(clips.train),
        validation_(clips.validation),
        model_(ConfigOf(options), clips.train.front().skeleton) {
    if (options.from.empty()) {
      Normalise();
    } else {
      const Safetensors content = ReadSafetensors(options.from);
      if (!HoldsControllers(content))
        throw InvalidArgument("--from", options.from.string() + " is no controllers network");
      StartFrom(ParseControllers(content, options.from.string()));
      ImportTensors(content, "", model_.get());
    }
    Open(model_.get());
  }

 protected:
  void TrainStep() override {
    Random random = RandomOf(step());
    model_->train();
    const ControlBatch batch = Draw(&random, static_cast<double>(step()) / options().steps);
    Descend(Walk(batch, model_->Prepare(batch.transition), std::pow(kTruthDecay, step())));
  }

  NamedFigures Validate() override {
    torch::NoGradGuard no_grad;
    model_->eval();
    NamedFigures figures;
    for (const int frames : kControlledFrames) {
      if (validation_.Longest() < model_->config().history_frames + frames) continue;
      Random random(kValidationSeed, static_cast<uint32_t>(frames));
      const ControlBatch batch = validation_.Draw(
          kControlValidationWindows, model_->config().history_frames, frames, {}, &random);
      const FrameTensors last =
          batch.transition.history.Narrow(batch.transition.history.size() - 1, 1);
      const auto distance = [&](const torch::Tensor& joints) {
        return (joints - batch.truth.joints).flatten(2).norm(2, -1).mean().item<double>();
      };
      const torch::Tensor u = torch::arange(1, frames + 1).view({1, frames, 1, 1}) / frames;
      const double straight =
          distance(last.joints + u * (batch.transition.target_joints.unsqueeze(1) - last.joints));
      const std::string n = std::to_string(frames);
      const FrameTensors out = model_->RollOut(batch.transition);
      figures.emplace_back("lrp_ratio_" + n, distance(out.joints) / straight);
      const torch::Tensor factors = FactorsOf(Steps(Join(last, out)), model_->shares());
      const torch::Tensor miss = (factors - batch.transition.factors).abs().mean({1, 2});
      figures.emplace_back("factor_cm_" + n, 100 * miss.mean().item<double>());
      figures.emplace_back("avf_" + n,
                           (miss < kVelocityTolerance).to(torch::kFloat).mean().item<double>());
      const torch::Tensor off = (out.root - batch.truth.root).norm(2, -1).mean(1);
      figures.emplace_back("art_" + n,
                           (off < kRootTolerance).to(torch::kFloat).mean().item<double>());
      const torch::Tensor heading = SubtractHeadings(out.facing, batch.truth.facing);
      figures.emplace_back(
          "heading_" + n,
          torch::atan2(heading.select(-1, 0), heading.select(-1, 1)).abs().mean().item<double>());
    }
    return figures;
  }

  std::string SaveModel(const std::filesystem::path& path, const nlohmann::json& card) override {
    return SaveControllers(path, model_, train_.MedianFactors(), card);
  }
  std::string Limits() const override {
    return "Trained on transitions of " + std::to_string(options().shortest) + " to " +
           std::to_string(options().longest) +
           " frames at 30 fps. It hears no music and is deterministic. Away from the keys it knows "
           "how fast limbs should be better than where: postures are those of a mean dancer. Feet "
           "slide without the foot lock.";
  }

 private:
  // Short windows first; the longest length rises until all are drawn. Later one draw in four is of
  // any length, the others rather short, which is cheap and common.
  ControlBatch Draw(Random* random, double progress) const {
    const double open = std::min(1.0, progress / kCurriculum);
    const int longest =
        options().shortest + static_cast<int>(open * (options().longest - options().shortest));
    const double u = random->Uniform();
    const double place = random->Uniform() < kLongest ? u : u * std::sqrt(u);
    const int frames = std::min(
        longest, options().shortest + static_cast<int>(place * (longest - options().shortest + 1)));
    return train_.Draw(WindowsOf(options().batch / 2, frames), model_->config().history_frames,
                       frames,
                       {.mirror = 0.5,
                        .tempo = 0.3,
                        .no_target = 0.05,
                        .smooth_path = 0.2,
                        .smooth_factors = 0.25,
                        .scale_factors = model_->config().velocity_factors ? 0.2 : 0.0},
                       random);
  }

  // Scheduled sampling without a loop over time: what the network would have walked is found by
  // letting it walk behind interpolation, all frames at once; of that and the real frames, each is
  // drawn with the probability that the paper has.
  LossTerms Walk(const ControlBatch& batch, const ControlledGiven& given, double truth_share) {
    const int64_t frames = batch.transition.frames;
    const auto& history = batch.transition.history;
    const FrameTensors lead = history.Narrow(history.size() - model_->lead(), model_->lead());
    const auto behind = [&](const FrameTensors& frames_before) {
      return Join(lead, frames_before.Narrow(0, frames - 1));
    };
    FrameTensors walked;
    {
      torch::NoGradGuard no_grad;
      ControllersState state;
      walked = model_->Walk(given, behind(model_->Planned(given).Detach()), &state).frames;
    }
    const torch::Tensor real =
        (torch::rand({batch.truth.root.size(0), frames, 1}) < truth_share).to(torch::kFloat);
    const auto mix = [&](const torch::Tensor& truth, const torch::Tensor& own) {
      const torch::Tensor share = truth.dim() == 4 ? real.unsqueeze(-1) : real;
      return own + share * (truth - own);
    };
    const FrameTensors mixed{
        mix(batch.truth.root, walked.root), mix(batch.truth.facing, walked.facing),
        mix(batch.truth.joints, walked.joints), mix(batch.truth.contacts, walked.contacts)};
    ControllersState state;
    const ControlledOutput output = model_->Walk(given, behind(mixed), &state);
    return ControlLoss(*model_, batch, output);
  }

  void Normalise() {
    Random random(options().seed + 3, 1);
    const ControlBatch batch = train_.Draw(kNormalisationWindows, model_->config().history_frames,
                                           30, {.mirror = 0.5}, &random);
    const torch::Tensor joints = batch.truth.joints.flatten(0, 1);
    model_->SetNormalisation(joints.mean(0), joints.std(0).clamp_min(0.02),
                             batch.factors.flatten(0, 1).std(0).clamp_min(1e-3));
  }

  ControlClips train_, validation_;
  ControllersModel model_;
};

}  // namespace

void TrainControllers(const TrainOptions& options) { TrainBy<ControlRun>(options); }

}  // namespace choreo
