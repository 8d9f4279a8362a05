#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/core/error.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/papers/networks/controllers_checkpoint.h"
#include "model/papers/training/control_clips.h"
#include "model/papers/training/control_losses.h"
#include "model/papers/training/paper_run.h"

namespace choreo {
namespace {

constexpr int kNormalisationWindows = 512;
constexpr int kControlValidationWindows = 48;
constexpr int kOwnPasses = 2;  // passes of scheduled sampling; each costs a third of a step

ControllersConfig ConfigOf(const PaperOptions& options) {
  ControllersConfig config;
  if (!options.name.empty()) config.name = options.name;
  config.residual = options.controllers.residual;
  config.absolute_position = !options.controllers.no_absolute_position;
  config.relative_position = !options.controllers.no_relative_position;
  config.two_lstms = !options.controllers.one_lstm;
  config.transformers = !options.controllers.condition_fc;
  config.root_decoder = !options.controllers.one_decoder;
  config.velocity_factors = !options.controllers.no_velocity_factors;
  config.key_loss = !options.no_key_loss;
  return config;
}

class ControlRun : public PaperRun {
 public:
  ControlRun(const PaperOptions& options, const TrainingClips& clips)
      : PaperRun(options, clips),
        train_(clips.train),
        validation_(clips.validation),
        model_(ConfigOf(options), clips.train.front().skeleton) {
    if (options.from.empty()) {
      Normalise();
    } else {
      const Safetensors content = ReadSafetensors(options.from);
      if (!HoldsControllers(content))
        throw InvalidArgument("--from", options.from.string() + " is not a controllers network");
      StartFrom(ParseControllers(content, options.from.string()));
      ImportTensors(content, "", model_.get());
    }
    Open(model_.get());
  }

 protected:
  void TrainStep() override {
    Random random = RandomOf(step());
    model_->train();
    const ControlBatch batch = Draw(&random);
    Descend(Walk(batch, model_->Prepare(batch.transition),
                 std::pow(options().controllers.truth_decay, step())));
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
           "slide without footwork.";
  }

 private:
  ControlBatch Draw(Random* random) const {
    const auto [least, most] =
        CurriculumAt(step(), options().steps, options().shortest, options().longest);
    const auto frames = static_cast<int>(random->Integer(least, most + 1));
    return train_.Draw(options().batch, model_->config().history_frames, frames,
                       {.mirror = 0.5,
                        .tempo = options().tempo,
                        .no_target = 0.05,
                        .smooth_path = 0.1,
                        .smooth_factors = 0.1},
                       random);
  }

  // Scheduled sampling: the frame before each is real with probability `truth_share`, otherwise the
  // network's own. The network's frames are computed in parallel (Duckworth et al. 2019): first
  // from real frames, then from the result.
  LossTerms Walk(const ControlBatch& batch, const ControlledGiven& given, double truth_share) {
    const int64_t lead = model_->lead(), frames = batch.transition.frames;
    const FrameTensors& history = batch.transition.history;
    const FrameTensors before = history.Narrow(history.size() - lead, lead);
    const torch::Tensor real =
        (torch::rand({batch.truth.root.size(0), frames, 1}) < truth_share).to(torch::kFloat);
    FrameTensors seen = batch.truth;
    const auto walk = [&] {
      ControllersState state;
      return model_->Walk(given, Join(before, seen.Narrow(0, frames - 1)), &state);
    };
    for (int pass = 0; pass < kOwnPasses; ++pass) {
      const torch::NoGradGuard no_grad;
      seen = Mix(batch.truth, walk().frames, real);
    }
    return ControlLoss(*model_, batch, walk());
  }

  // Takes `truth` where `real` is 1, the network's frames where it is 0.
  static FrameTensors Mix(const FrameTensors& truth, const FrameTensors& own,
                          const torch::Tensor& real) {
    const auto mix = [&](const torch::Tensor& a, const torch::Tensor& b) {
      return b + (a.dim() == 4 ? real.unsqueeze(-1) : real) * (a - b);
    };
    return {mix(truth.root, own.root), mix(truth.facing, own.facing), mix(truth.joints, own.joints),
            mix(truth.contacts, own.contacts)};
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

void TrainControllers(const PaperOptions& options) { TrainBy<ControlRun>(options); }

}  // namespace choreo
