#include <torch/types.h>
#include <torch/utils.h>

#include <vector>

#include "model/core/error.h"
#include "model/papers/networks/inbetweener.h"
#include "model/papers/training/flow_losses.h"
#include "model/papers/training/paper_run.h"

namespace choreo {
namespace {

constexpr int kInbetweenValidationWindows = 64;
constexpr int kSpreadBatches = 8;
constexpr double kMinSpread = 0.02;  // metres, radians: for joints that hardly move
// Weights of rotations and contacts relative to positions in decimetres.
constexpr double kTurnWeight = 1, kContactWeight = 0.1;

FlowConfig ConfigOfInbetweener(const PaperOptions& options) {
  FlowConfig config = FlowConfig::Preset(options.preset);
  if (!options.name.empty()) config.name = options.name;
  if (options.flow.hidden > 0) config.hidden = options.flow.hidden;
  return config;
}

class InbetweenRun : public PaperRun {
 public:
  InbetweenRun(const PaperOptions& options, const TrainingClips& clips)
      : PaperRun(options, clips),
        clips_(clips),
        skeleton_(clips.train.front().skeleton),
        kinematics_(skeleton_),
        model_(ConfigOfInbetweener(options), skeleton_) {
    if (!options.from.empty()) {
      const Safetensors content = ReadSafetensors(options.from);
      StartFrom(ParseInbetweener(content, options.from.string()));
      ImportTensors(content, "", model_.get());
    }
    Open(model_.get());
  }

 protected:
  void Prepare() override {
    if (!options().from.empty()) return;
    std::vector<torch::Tensor> seen;
    for (int i = 0; i < kSpreadBatches; ++i) {
      Random random(options().seed + 7, static_cast<uint32_t>(i + 1));
      seen.push_back(Draw(&random, options().longest).features.flatten(0, 1));
    }
    const torch::Tensor all = torch::cat(seen);
    model_->SetNormalisation(all.mean(0), all.std(0).clamp_min(kMinSpread));
  }

  // L1 of joint positions, rotations and contacts over a roll-out.
  void TrainStep() override {
    Random random = RandomOf(step());
    model_->train();
    const MotionBatch batch = Draw(&random, DrawnLength(options(), &random));
    const torch::Tensor made = RollOut(batch);
    const TrajectoryTensors poses = DecodePoses(skeleton_, made);
    const int64_t contacts = made.size(2) - 4;
    const torch::Tensor real =
        batch.features.narrow(1, model_->config().history_frames, batch.transition.frames);
    Descend(
        {{"way_dm", 1, kDecimetresPerMetre * JointDistance(kinematics_, poses, batch.truth).mean()},
         {"rotation_l1", kTurnWeight, (poses.rotation - batch.truth.rotation).abs().mean()},
         {"contact_l1", kContactWeight,
          (made.narrow(2, contacts, 4) - real.narrow(2, contacts, 4)).abs().mean()}});
  }

  // Measures, without arrival, L2P over interpolation's and the mean joint distance at keys.
  NamedFigures Validate() override {
    const torch::NoGradGuard no_grad;
    model_->eval();
    NamedFigures figures;
    for (const int frames : kComparedFrames) {
      Random random(kValidationSeed, static_cast<uint32_t>(frames));
      const MotionBatch batch =
          DrawMotion(clips_.validation, kInbetweenValidationWindows,
                     model_->config().history_frames, frames, {}, torch::kCPU, &random);
      const auto distance = [&](const TrajectoryTensors& poses, const TrajectoryTensors& truth) {
        return JointDistance(kinematics_, poses, truth).mean().item<double>();
      };
      const TrajectoryTensors made = DecodePoses(skeleton_, RollOut(batch));
      const std::string n = std::to_string(frames);
      figures.insert(figures.end(),
                     {{"l2p_ratio_" + n, distance(made, batch.truth) /
                                             distance(Interpolate(batch.transition), batch.truth)},
                      {"mean_key_m_" + n, distance(LastFrame(made), LastFrame(batch.truth))}});
    }
    return figures;
  }

  std::string SaveModel(const std::filesystem::path& path, const nlohmann::json& card) override {
    return SaveInbetweener(path, model_, card);
  }
  std::string Limits() const override {
    return "A baseline, trained on transitions of " + std::to_string(options().shortest) + " to " +
           std::to_string(options().longest) +
           " frames at 30 fps. It hears no music and is deterministic.";
  }

 private:
  MotionBatch Draw(Random* random, int frames) const {
    return DrawMotion(clips_.train, WindowsOf(options().batch, frames),
                      model_->config().history_frames, frames, VariationOf(options(), true),
                      torch::kCPU, random);
  }
  torch::Tensor RollOut(const MotionBatch& batch) {
    return model_->Rollout(batch.features.narrow(1, 0, model_->config().history_frames),
                           KeyConditionTensors(model_->config(), skeleton_, batch.transition));
  }

  const TrainingClips& clips_;
  Skeleton skeleton_;
  TorchKinematics kinematics_;
  Inbetweener model_;
};

}  // namespace

void TrainInbetweener(const PaperOptions& options) { TrainBy<InbetweenRun>(options); }

}  // namespace choreo
