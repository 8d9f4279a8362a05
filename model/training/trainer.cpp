#include "model/training/trainer.h"

#include <torch/torch.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "model/core/error.h"
#include "model/core/progress.h"
#include "model/flow/checkpoint.h"
#include "model/training/adam.h"
#include "model/training/curves.h"
#include "model/training/losses.h"
#include "model/training/validation.h"

namespace choreo {
namespace {

constexpr int64_t kWarmUpSteps = 200;
constexpr double kLastRate = 0.05;  // share of the peak learning rate at the end of a stage
constexpr double kMaxGradientNorm = 1.0;
constexpr int kNormalisationBatches = 24;
constexpr int kValidationWindows = 64;
constexpr int kTypicalFrames = 60;  // a batch of windows this long has `batch` of them

// Standardised features keep at least these spreads, so that constant joints can't make the density
// unbounded: metres, radians, m/s and rad/s, contacts.
constexpr double kPositionFloor = 0.005, kRotationFloor = 0.01, kVelocityFloor = 0.02,
                 kContactFloor = 0.1;

// Root position (m) and 6D rotations of real poses, for the planner's tokens.
constexpr double kPoseFloor = 0.03;

double StageRate(double peak, int64_t step, int64_t steps) {
  const double warm = std::min(1.0, static_cast<double>(step + 1) / kWarmUpSteps);
  const double progress =
      static_cast<double>(step) / static_cast<double>(std::max<int64_t>(1, steps));
  return peak * warm * (kLastRate + (1 - kLastRate) * 0.5 * (1 + std::cos(M_PI * progress)));
}

FlowConfig ConfigOf(const TrainOptions& options) {
  FlowConfig config = FlowConfig::Preset(options.preset);
  config.keys = !options.no_keys;
  config.key_loss = !options.no_key_loss && config.keys;
  config.time_embedding = !options.no_time_embedding;
  config.forward_embedding = options.forward_embedding;
  return config;
}

// What a stranger types to train the same.
std::string CommandOf(const TrainOptions& options) {
  std::ostringstream command;
  command << "choreo-lab train --preset " << options.preset;
  for (const auto& folder : options.data) command << " --data " << folder.filename().string();
  command << " --splits " << options.splits.filename().string() << " --planner-steps "
          << options.planner_steps << " --flow-steps " << options.flow_steps << " --batch "
          << options.batch << " --planner-rate " << options.planner_rate << " --flow-rate "
          << options.flow_rate << " --shortest " << options.shortest << " --longest "
          << options.longest << " --rollout-frames " << options.rollout_frames << " --seed "
          << options.seed << (options.no_keys ? " --no-keys" : "")
          << (options.no_key_loss ? " --no-key-loss" : "")
          << (options.no_time_embedding ? " --no-time-embedding" : "")
          << (options.forward_embedding ? " --forward-embedding" : "");
  return command.str();
}

// One run in progress. Each step draws from a generator of its own, so a resumed run goes on
// exactly as an undisturbed one.
class Run {
 public:
  explicit Run(const TrainOptions& options)
      : options_(options),
        train_(options.data, options.splits, Split::kTrain),
        validation_(options.data, options.splits, Split::kValidation),
        kinematics_(train_.skeleton()),
        device_(options.device) {
    torch::manual_seed(options.seed);
    model_ = FlowModel(ConfigOf(options), train_.skeleton());
    planner_steps_ = model_->has_planner() ? options.planner_steps : 0;
    SetAudioNormalisation();
    if (model_->has_planner()) SetPoseNormalisation();
    model_->to(device_);
    planner_adam_ = std::make_unique<Adam>(*model_, "planner.");
    flow_adam_ = std::make_unique<Adam>(*model_, "flow.");
    encoder_adam_ = std::make_unique<Adam>(*model_, "encode");
    std::filesystem::create_directories(options.run);
    if (options.resume && std::filesystem::exists(StatePath())) Load();
  }

  void Go() {
    const int64_t total = planner_steps_ + options_.flow_steps;
    ProgressBar progress("train " + options_.preset, total - step_);
    const auto start = std::chrono::steady_clock::now();
    const double seconds_before = seconds_;
    for (; step_ < total; ++step_) {
      if (step_ == planner_steps_) StartFlowStage();
      TrainStep();
      seconds_ = seconds_before +
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      progress.Advance();
      if ((step_ + 1) % options_.report_every == 0 || step_ + 1 == total) Report();
      if (step_ + 1 == options_.stop_after) return;
    }
    Finish();
  }

 private:
  bool flow_stage() const { return step_ >= planner_steps_; }
  std::filesystem::path StatePath() const { return options_.run / "state.safetensors"; }

  MotionBatch Draw(Random* random, int frames) const {
    const int windows =
        std::max(8, options_.batch * kTypicalFrames / std::max(frames, kTypicalFrames / 3));
    const bool keys = model_->config().keys;
    const ClipStore::Variation variation{.mirror = true,
                                         .drop_key = keys ? 0.1 : 1.0,
                                         .drop_audio = 0.15,
                                         .partial_key = keys ? 0.1 : 0.0,
                                         .hold_history = 0.05};
    return train_.Draw(windows, model_->config().history_frames, frames, variation, random)
        .To(device_);
  }

  void TrainStep() {
    Random random(options_.seed, static_cast<uint32_t>(step_ + 1));
    torch::manual_seed(options_.seed + static_cast<uint64_t>(step_) * 1000003);
    model_->train();
    // Short transitions are common in use and cheap: half of the draws are quadratic towards the
    // short end.
    const double u = random.Uniform();
    const double place = random.Uniform() < 0.5 ? u * u : u;
    const int frames =
        options_.shortest + static_cast<int>(place * (options_.longest - options_.shortest + 1));
    const MotionBatch batch = Draw(&random, frames);
    losses_.step = step_ + 1;
    if (!flow_stage()) {
      planner_adam_->ZeroGrad();
      const torch::Tensor loss =
          PlannerLoss(kinematics_, batch, model_->planner()->forward(batch.transition).trajectory);
      loss.backward();
      const double rate = StageRate(options_.planner_rate, step_, planner_steps_);
      losses_.planner_gradient = planner_adam_->Step(rate, kMaxGradientNorm);
      losses_.planner = Smooth(losses_.planner, loss.item<double>());
      return;
    }
    FlowStep(batch, &random);
  }

  void FlowStep(const MotionBatch& batch, Random* random) {
    const FlowLossWeights weights;
    const auto zero = [&] {
      flow_adam_->ZeroGrad();
      encoder_adam_->ZeroGrad();
    };
    // The planner is frozen here: its trajectory and hidden state are inputs, not something to be
    // moved by the flow.
    const auto begin = [&](const MotionBatch& of) {
      TransitionContext context = model_->Begin(of.transition);
      if (context.reference.position.defined()) {
        context.reference.position = context.reference.position.detach();
        context.reference.rotation = context.reference.rotation.detach();
      }
      return context;
    };
    for (auto& parameter : FrozenParameters()) parameter.set_requires_grad(false);
    const TransitionContext context = begin(batch);
    zero();
    const torch::Tensor likelihood = LikelihoodLoss(model_, batch, context);
    (weights.likelihood * likelihood).backward();
    losses_.likelihood = Smooth(losses_.likelihood, likelihood.item<double>());
    losses_.likelihood_gradient = FlowGradient();

    if (model_->config().key_loss) {
      const int windows = std::max(4, options_.batch / 4);
      const ClipStore::Variation variation{.mirror = true, .drop_audio = 0.15};
      const MotionBatch sampled = train_
                                      .Draw(windows, model_->config().history_frames,
                                            options_.rollout_frames, variation, random)
                                      .To(device_);
      const auto [key, contacts] =
          RolloutLosses(model_, kinematics_, sampled, begin(sampled), model_->config().temperature);
      const double before = losses_.likelihood_gradient;
      (weights.key_pose * key + weights.contacts * contacts).backward();
      losses_.key_pose = Smooth(losses_.key_pose, key.item<double>());
      losses_.contacts = Smooth(losses_.contacts, contacts.item<double>());
      // Of the sum less the first term's share: an upper bound is enough to see a term vanish or
      // take over.
      losses_.rollout_gradient = std::abs(FlowGradient() - before);
    }
    const double rate = StageRate(options_.flow_rate, step_ - planner_steps_, options_.flow_steps);
    flow_adam_->Step(rate, kMaxGradientNorm);
    encoder_adam_->Step(rate, kMaxGradientNorm);
  }

  std::vector<torch::Tensor> FrozenParameters() const {
    return model_->has_planner() ? model_->planner()->parameters() : std::vector<torch::Tensor>{};
  }
  double FlowGradient() const {
    return std::hypot(GradientNorm(*model_, "flow."), GradientNorm(*model_, "encode"));
  }
  static double Smooth(double old, double value) {
    return old == 0 ? value : 0.98 * old + 0.02 * value;
  }

  void SetAudioNormalisation() {
    const int width = model_->config().audio_features;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(width), square = sum;
    double count = 0;
    for (const auto& clip : train_.clips()) {
      sum += clip.audio.cast<double>().rowwise().sum();
      square += clip.audio.cast<double>().array().square().matrix().rowwise().sum();
      count += static_cast<double>(clip.audio.cols());
    }
    normalisation_ = {torch::zeros({model_->feature_width()}),
                      torch::ones({model_->feature_width()}), torch::zeros({width}),
                      torch::ones({width})};
    for (int i = 0; i < width && count > 0; ++i) {
      const double mean = sum[i] / count;
      normalisation_.audio_mean[i] = mean;
      normalisation_.audio_std[i] = std::sqrt(std::max(1e-4, square[i] / count - mean * mean));
    }
    model_->SetNormalisation(normalisation_);
  }

  void SetPoseNormalisation() {
    std::vector<torch::Tensor> seen;
    for (int i = 0; i < kNormalisationBatches; ++i) {
      Random random(options_.seed + 3, static_cast<uint32_t>(i + 1));
      const MotionBatch batch = train_.Draw(options_.batch, model_->config().history_frames,
                                            options_.rollout_frames, {.mirror = true}, &random);
      seen.push_back(
          torch::cat({batch.truth.position, SixDBatch(batch.truth.rotation).flatten(2)}, -1)
              .flatten(0, 1));
    }
    const torch::Tensor all = torch::cat(seen);
    model_->planner()->SetPoseNormalisation(all.mean(0), all.std(0).clamp_min(kPoseFloor));
  }

  // Statistics of the features that the flow will see, which with a planner are what the finished
  // planner leaves over.
  void StartFlowStage() {
    torch::NoGradGuard no_grad;
    model_->eval();
    std::vector<torch::Tensor> seen;
    MotionBatch last;
    for (int i = 0; i < kNormalisationBatches; ++i) {
      Random random(options_.seed + 7, static_cast<uint32_t>(i + 1));
      last = Draw(&random, options_.rollout_frames + (i % 3) * 20);
      const TransitionContext context = model_->Begin(last.transition);
      const torch::Tensor features = model_->RelativeFeatures(last.features, last.truth, context);
      seen.push_back(features.narrow(1, model_->config().history_frames, last.transition.frames)
                         .flatten(0, 1));
    }
    const torch::Tensor all = torch::cat(seen).to(torch::kCPU);
    const int64_t joints = train_.skeleton().joints(), width = model_->feature_width();
    torch::Tensor floor = torch::full({width}, kRotationFloor);
    floor.narrow(0, 0, 3).fill_(kPositionFloor);
    floor.narrow(0, 3 + 3 * joints, 3).fill_(kVelocityFloor);
    floor.narrow(0, width - 4, 4).fill_(kContactFloor);
    normalisation_.feature_mean = all.mean(0);
    normalisation_.feature_std = torch::maximum(all.std(0), floor);
    if (model_->has_planner()) {
      // A plan is unbiased, and history features are exactly zero: keep zero where it is.
      normalisation_.feature_mean.narrow(0, 0, 3 + 3 * joints).zero_();
    }
    model_->SetNormalisation(normalisation_);
    const TransitionContext context = model_->Begin(last.transition);
    const torch::Tensor features = model_->RelativeFeatures(last.features, last.truth, context);
    model_->InitialiseActNorm(Dequantise(model_, features), last.audio, last.has_audio, context);
  }

  void Report() {
    const std::vector<ValidationRow> rows =
        Validate(model_, validation_, {10, 30, 60, 90}, kValidationWindows, flow_stage());
    curves_.Append(losses_, seconds_, rows);
    curves_.Write(options_.run);
    Save();
  }

  void Save() {
    Safetensors state;
    ExportTensors(*model_, "model.", &state);
    planner_adam_->Export(&state);
    // Three optimisers share the step count's key; the flow's two always agree.
    const std::string planner_count = state.metadata["adam.steps"];
    encoder_adam_->Export(&state);
    flow_adam_->Export(&state);
    state.metadata["adam.planner_steps"] = planner_count;
    state.metadata["step"] = std::to_string(step_ + 1);
    state.metadata["seconds"] = std::to_string(seconds_);
    state.metadata["data"] = train_.Hash();
    state.metadata["curves"] = curves_.Serialise();
    WriteSafetensors(StatePath(), state);
  }

  void Load() {
    Safetensors state = ReadSafetensors(StatePath());
    if (state.metadata.at("data") != train_.Hash()) {
      throw Error(ErrorCode::kFailedPrecondition, StatePath().string(),
                  "the run was started on other data (hash " + state.metadata.at("data") + ")");
    }
    ImportTensors(state, "model.", model_.get());
    flow_adam_->Import(state);
    encoder_adam_->Import(state);
    state.metadata["adam.steps"] = state.metadata.at("adam.planner_steps");
    planner_adam_->Import(state);
    step_ = std::stoll(state.metadata.at("step"));
    seconds_ = std::stod(state.metadata.at("seconds"));
    curves_.Restore(state.metadata.at("curves"));
  }

  void Finish() {
    const std::vector<ValidationRow> rows =
        Validate(model_, validation_, {10, 30, 60, 90}, kValidationWindows, true);
    nlohmann::json figures = nlohmann::json::array();
    for (const ValidationRow& row : rows) {
      figures.push_back({{"frames", row.frames},
                         {"interpolation_m", row.interpolation_m},
                         {"planner_m", row.planner_m},
                         {"flow_m", row.flow_m},
                         {"ratio_to_interpolation", row.flow_m / row.interpolation_m},
                         {"nll_nats_per_dimension", row.likelihood},
                         {"raw_key_error_m", row.key_error_m}});
    }
    nlohmann::json sources = nlohmann::json::object(), terms = nlohmann::json::object();
    for (const auto& clip : train_.clips()) {
      sources[clip.source] = sources.value(clip.source, 0) + 1;
      const auto stated = clip.notes.find("terms");
      const std::string of = stated == clip.notes.end() ? "not stated" : stated->second;
      terms[of] = terms.value(of, 0) + 1;
    }
    const nlohmann::json card = {
        {"preset", options_.preset},
        {"data",
         {{"clips_by_layout", sources},
          {"clips_by_terms", terms},
          {"frames", train_.frames()},
          {"hash", train_.Hash()}}},
        {"licence", "the terms of the data that it was trained on: model/checkpoints/LICENSE"},
        {"command", CommandOf(options_)},
        {"steps", {{"planner", planner_steps_}, {"flow", options_.flow_steps}}},
        {"seconds", std::round(seconds_)},
        {"validation", figures},
        {"limits",
         "Trained on transitions of " + std::to_string(options_.shortest) + " to " +
             std::to_string(options_.longest) +
             " frames at 30 fps. The plan does not hear the music, the flow around it does; steps "
             "are not aligned to beats. Without keys it drifts towards calm poses. Feet may slide. "
             "What the data lacks (lying, acrobatics, props, partners) it can't do."}};
    const std::string hash = SaveCheckpoint(options_.run / "checkpoint.safetensors", model_, card);
    std::printf("%s\n", card.dump(2).c_str());
    std::printf("checkpoint %s, content hash %s\n",
                (options_.run / "checkpoint.safetensors").string().c_str(), hash.c_str());
  }

  TrainOptions options_;
  ClipStore train_, validation_;
  TorchKinematics kinematics_;
  torch::Device device_;
  FlowModel model_{nullptr};
  std::unique_ptr<Adam> planner_adam_, flow_adam_, encoder_adam_;
  Normalisation normalisation_;
  int64_t planner_steps_ = 0;
  int64_t step_ = 0;
  double seconds_ = 0;
  LossRow losses_;
  Curves curves_;
};

}  // namespace

void TrainOptions::Validate() const {
  const auto require = [](bool good, const char* name, const std::string& value,
                          const char* limit) {
    if (!good) throw InvalidArgument(name, value + ", but it must be " + limit);
  };
  require(!data.empty(), "--data", "nothing", "at least one folder of prepared clips");
  require(planner_steps >= 1, "--planner-steps", std::to_string(planner_steps), "at least 1");
  require(flow_steps >= 1, "--flow-steps", std::to_string(flow_steps), "at least 1");
  require(batch >= 4 && batch <= 4096, "--batch", std::to_string(batch), "4 to 4096");
  require(shortest >= 2 && shortest <= longest && longest <= 600, "--longest",
          std::to_string(longest), "from --shortest (at least 2) to 600");
  require(rollout_frames >= 2 && rollout_frames <= 300, "--rollout-frames",
          std::to_string(rollout_frames), "2 to 300");
  require(report_every >= 1, "--report-every", std::to_string(report_every), "at least 1");
}

void Train(const TrainOptions& options) {
  options.Validate();
  Run run(options);
  run.Go();
}

}  // namespace choreo
