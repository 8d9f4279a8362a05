#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/papers/networks/flow_checkpoint.h"
#include "model/papers/training/flow_losses.h"
#include "model/papers/training/paper_run.h"

namespace choreo {
namespace {

constexpr int kNormalisationBatches = 24;
constexpr int kValidationWindows = 64;
// The least spreads for standardising features: metres, radians, m/s and rad/s, contacts.
constexpr double kPositionFloor = 0.005, kRotationFloor = 0.01, kVelocityFloor = 0.02,
                 kContactFloor = 0.1;
constexpr double kInnovationFloor = 0.1;  // the same for innovations, as a share of those
constexpr double kAudioVarianceFloor = 1e-4;

FlowConfig ConfigOf(const PaperOptions& options, const std::vector<PreparedClip>& clips) {
  FlowConfig config = FlowConfig::Preset(options.preset);
  if (!options.name.empty()) config.name = options.name;
  if (options.flow.flow_steps > 0) config.flow_steps = options.flow.flow_steps;
  if (options.flow.hidden > 0) config.hidden = options.flow.hidden;
  if (options.flow.condition_width >= 0) config.condition_width = options.flow.condition_width;
  if (options.flow.no_innovations) config.innovations = false;
  config.temperature = options.flow.temperature;
  config.keys = !options.flow.no_keys;
  config.key_loss = !options.no_key_loss && config.keys;
  config.time_embedding = !options.flow.no_time_embedding;
  config.forward_embedding = options.flow.forward_embedding;
  config.hears_music =
      std::ranges::any_of(clips, [](const auto& clip) { return clip.audio.cols() > 0; });
  return config;
}

// Music rows of all clips.
void NormaliseAudio(const std::vector<PreparedClip>& clips, FlowModel& model) {
  const int width = model->config().audio_features;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(width), square = sum;
  double count = 0;
  for (const auto& clip : clips) {
    sum += clip.audio.cast<double>().rowwise().sum();
    square += clip.audio.cast<double>().array().square().matrix().rowwise().sum();
    count += static_cast<double>(clip.audio.cols());
  }
  if (count == 0) return;  // no clip has music
  torch::Tensor mean = torch::empty({width}), std = torch::empty({width});
  for (int i = 0; i < width; ++i) {
    const double m = sum[i] / count;
    mean[i] = m;
    std[i] = std::sqrt(std::max(kAudioVarianceFloor, square[i] / count - m * m));
  }
  model->SetAudioNormalisation(mean, std);
}

// Normalises features by the last frames of `windows` of real motion [n, tau + 1, width]. Spreads
// have floors, so that constant joints cannot make the density unbounded.
void NormaliseFeatures(const torch::Tensor& windows, FlowModel& flow) {
  const int64_t joints = flow->skeleton().joints(), width = flow->feature_width();
  torch::Tensor floor = torch::full({width}, kRotationFloor);
  floor.narrow(0, 0, 3).fill_(kPositionFloor);
  floor.narrow(0, 3 + 3 * joints, 3).fill_(kVelocityFloor);
  floor.narrow(0, width - 4, 4).fill_(kContactFloor);
  const torch::Tensor all = windows.select(1, windows.size(1) - 1);
  flow->SetFeatureNormalisation(all.mean(0), torch::maximum(all.std(0), floor));
  if (flow->config().innovations) flow->FitPrediction(windows, kInnovationFloor * floor);
}

class FlowRun : public PaperRun {
 public:
  FlowRun(const PaperOptions& options, const TrainingClips& clips)
      : PaperRun(options, clips),
        clips_(clips),
        kinematics_(clips.train.front().skeleton),
        device_(options.device),
        model_(ConfigOf(options, clips.train), clips.train.front().skeleton) {
    if (options.from.empty()) {
      NormaliseAudio(clips.train, model_);
    } else {
      const Safetensors content = ReadSafetensors(options.from);
      StartFrom(ParseCheckpoint(content, options.from.string()));
      ImportTensors(content, "", model_.get());
    }
    rollout_.way = options.flow.rollout_loss;
    if (!model_->config().key_loss) rollout_.key = 0;
    model_->to(device_);
    Open(model_.get());
  }

 protected:
  // Initialises normalisation and ActNorm from data.
  void Prepare() override {
    if (!options().from.empty()) return;
    torch::NoGradGuard no_grad;
    torch::manual_seed(options().seed + 13);
    model_->eval();
    std::vector<torch::Tensor> seen;
    MotionBatch batch;
    for (int i = 0; i < kNormalisationBatches; ++i) {
      Random random(options().seed + 7, static_cast<uint32_t>(i + 1));
      batch = Draw(&random, options().shortest + (options().longest - options().shortest) * i /
                                                     (kNormalisationBatches - 1));
      // [windows, N, width, tau + 1]
      seen.push_back(batch.features.unfold(1, model_->config().history_frames + 1, 1)
                         .flatten(0, 1)
                         .transpose(1, 2)
                         .to(torch::kCPU));
    }
    NormaliseFeatures(torch::cat(seen), model_);
    model_->InitialiseActNorm(Dequantise(model_, batch.features, options().flow.dequantise),
                              batch.audio, batch.has_audio,
                              model_->StaticCondition(batch.transition));
  }

  void TrainStep() override {
    Random random = RandomOf(step());
    model_->train();
    const MotionBatch batch = Draw(&random, DrawnLength(options(), &random));
    Descend(LikelihoodLoss(model_, batch, model_->StaticCondition(batch.transition),
                           options().flow.dequantise));
    if (step() < options().flow.rollout_from) return;
    const MotionBatch sampled =
        batch.First(std::lround(options().flow.rollout_share * batch.features.size(0)));
    Descend(RolloutLoss(model_, kinematics_, sampled, model_->StaticCondition(sampled.transition),
                        /*temperature=*/1, rollout_));
  }

  // Measures on fixed windows, without arrival, one roll-out at temperature 1: its L2P over
  // interpolation's, and the mean joint distance at its key frame; and -log p, nats per dimension.
  NamedFigures Validate() override {
    const torch::NoGradGuard no_grad;
    model_->eval();
    const int history = model_->config().history_frames;
    NamedFigures figures;
    for (const int frames : kComparedFrames) {
      Random random(kValidationSeed, static_cast<uint32_t>(frames));
      const MotionBatch batch =
          DrawMotion(clips_.validation, kValidationWindows, history, frames, {}, device_, &random);
      const torch::Tensor condition = model_->StaticCondition(batch.transition);
      const auto distance = [&](const TrajectoryTensors& poses, const TrajectoryTensors& truth) {
        return JointDistance(kinematics_, poses, truth).mean().item<double>();
      };
      const torch::Tensor& truth = batch.features;
      const double likelihood =
          model_->LogLikelihood(truth, batch.audio, batch.has_audio, condition)
              .mean()
              .item<double>() /
          model_->feature_width();
      std::vector<float> values(static_cast<size_t>(truth.size(0)) * frames * truth.size(2));
      random.FillNormal(values);
      const torch::Tensor noise =
          torch::from_blob(values.data(), {truth.size(0), frames, truth.size(2)}).to(device_);
      const TrajectoryTensors danced =
          DecodePoses(model_->skeleton(), model_->Rollout(truth.narrow(1, 0, history), batch.audio,
                                                          batch.has_audio, condition, noise));
      const std::string n = std::to_string(frames);
      figures.insert(figures.end(),
                     {{"flow_ratio_" + n, distance(danced, batch.truth) /
                                              distance(Interpolate(batch.transition), batch.truth)},
                      {"val_nll_" + n, -likelihood},
                      {"mean_key_m_" + n, distance(LastFrame(danced), LastFrame(batch.truth))}});
    }
    return figures;
  }

  std::string SaveModel(const std::filesystem::path& path, const nlohmann::json& card) override {
    Safetensors weights;
    ExportTensors(*model_, "", &weights);
    for (auto& [name, tensor] : weights.tensors) {
      // Halves the file. Tensors that the flow inverts stay exact.
      if (name.find("weight") != std::string::npos) RoundToBfloat16(&tensor);
    }
    return SaveCheckpoint(path, model_, std::move(weights), card);
  }
  std::string Limits() const override {
    return "Trained on transitions of " + std::to_string(options().shortest) + " to " +
           std::to_string(options().longest) +
           " frames at 30 fps. Feet may slide in short transitions. What the data lacks (lying, "
           "acrobatics, props, partners) it can't do.";
  }

 private:
  MotionBatch Draw(Random* random, int frames) const {
    const int windows = WindowsOf(options().batch, frames);
    return DrawMotion(clips_.train, windows, model_->config().history_frames, frames,
                      VariationOf(options(), model_->config().keys), device_, random);
  }

  const TrainingClips& clips_;
  TorchKinematics kinematics_;
  torch::Device device_;
  FlowModel model_;
  RolloutWeights rollout_;
};

}  // namespace

void TrainFlow(const PaperOptions& options) { TrainBy<FlowRun>(options); }

}  // namespace choreo
