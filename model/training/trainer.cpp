#include "model/training/trainer.h"

#include <torch/torch.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "model/core/progress.h"
#include "model/flow/checkpoint.h"
#include "model/training/adam.h"
#include "model/training/curves.h"
#include "model/training/fit_variety.h"
#include "model/training/losses.h"
#include "model/training/model_card.h"
#include "model/training/normalise.h"
#include "model/training/validation.h"

namespace choreo {
namespace {

constexpr int64_t kWarmUpSteps = 200;
constexpr double kLastRate = 0.05;  // share of the peak learning rate at the end of a stage
constexpr double kMaxGradientNorm = 1.0;
constexpr int kNormalisationBatches = 24;
constexpr int kValidationWindows = 64;
constexpr int kTypicalFrames = 60;  // a batch of windows this long has `batch` of them

double StageRate(double peak, int64_t step, int64_t steps) {
  const double warm = std::min(1.0, static_cast<double>(step + 1) / kWarmUpSteps);
  const double progress =
      static_cast<double>(step) / static_cast<double>(std::max<int64_t>(1, steps));
  return peak * warm * (kLastRate + (1 - kLastRate) * 0.5 * (1 + std::cos(M_PI * progress)));
}

FlowConfig ConfigOf(const TrainOptions& options, const ClipStore& clips) {
  FlowConfig config = FlowConfig::Preset(options.preset);
  if (!options.name.empty()) config.name = options.name;
  config.keys = !options.no_keys;
  config.key_loss = !options.no_key_loss && config.keys;
  config.time_embedding = !options.no_time_embedding;
  config.forward_embedding = options.forward_embedding;
  config.hears_music = clips.HasMusic();
  return config;
}

// One run in progress. Each step draws from a generator of its own, so a resumed run goes on
// exactly as an undisturbed one.
class Run {
 public:
  explicit Run(const TrainOptions& options)
      : options_(options),
        train_(options.data, options.splits,
               options.with_validation ? Split::kTrainAndValidation : Split::kTrain),
        validation_(options.data, options.splits, Split::kValidation),
        kinematics_(train_.skeleton()),
        device_(options.device) {
    torch::manual_seed(options.seed);
    model_ = FlowModel(ConfigOf(options, train_), train_.skeleton());
    planner_steps_ = model_->has_planner() ? options.planner_steps : 0;
    flow_steps_ = model_->config().flow_steps > 0 ? options.flow_steps : 0;
    NormaliseAudio(train_, &model_);
    if (model_->has_planner() && options.planner.empty()) NormalisePoses(PoseBatches(), &model_);
    if (!options.planner.empty()) TakePlanner();
    model_->to(device_);
    planner_adam_ = std::make_unique<Adam>(*model_, "planner.");
    flow_adam_ = std::make_unique<Adam>(*model_, "flow.");
    encoder_adam_ = std::make_unique<Adam>(*model_, "encode");
    for (const std::string& name : LossTermNames()) losses_.terms[name];
    std::filesystem::create_directories(options.run);
    if (!std::filesystem::exists(StatePath())) return;
    if (!options.resume) {
      throw Error(
          ErrorCode::kFailedPrecondition, "--run",
          options.run.string() + " holds a run already: --resume it or name another folder");
    }
    Load();
  }

  void Go() {
    const int64_t total = planner_steps_ + flow_steps_;
    ProgressBar progress("train " + options_.preset, total - step_);
    const auto start = std::chrono::steady_clock::now();
    const double seconds_before = seconds_;
    for (; step_ < total; ++step_) {
      if (step_ == planner_steps_) StartFlowStage();
      TrainStep();
      seconds_ = seconds_before +
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      progress.Advance();
      const bool stop = step_ + 1 == options_.stop_after;
      if ((step_ + 1) % options_.report_every == 0 || step_ + 1 == total) {
        Report();
      } else if (stop) {
        Save();
      }
      if (stop) return;
    }
    if (flow_steps_ == 0) StartFlowStage();
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
                                         .tempo = flow_stage() ? 0.0 : options_.tempo,
                                         .hold_history = 0.05};
    return train_.Draw(windows, model_->config().history_frames, frames, variation, random)
        .To(device_);
  }

  // Of another run's checkpoint the planner alone: its flow may have another shape.
  void TakePlanner() {
    if (!model_->has_planner())
      throw InvalidArgument("--planner", "preset " + options_.preset + " has no planner");
    const Checkpoint base = LoadCheckpoint(options_.planner);
    const PlannerConfig &theirs = base.model->config().planner, &ours = model_->config().planner;
    if (!(base.model->skeleton() == model_->skeleton()) || theirs.width != ours.width ||
        theirs.layers != ours.layers || theirs.heads != ours.heads ||
        theirs.recurrent != ours.recurrent) {
      throw InvalidArgument("--planner", options_.planner.string() +
                                             " has a planner of another shape than preset " +
                                             options_.preset + " on these clips");
    }
    Safetensors planner;
    ExportTensors(*base.model->planner(), "planner.", &planner);
    ImportTensors(planner, "planner.", model_->planner().get());
    base_ = {{"hash", base.hash}, {"card", nlohmann::json::parse(base.card)}};
  }

  std::string PlannerFrom() const {
    return base_.is_null() ? "" : base_.at("hash").get<std::string>();
  }

  void TrainStep() {
    Random random(options_.seed, static_cast<uint32_t>(step_ + 1));
    torch::manual_seed(options_.seed + static_cast<uint64_t>(step_) * 1000003);
    model_->train();
    if (flow_stage() && model_->has_planner()) model_->planner()->eval();
    // Short transitions are common in use and cheap: half of the draws are quadratic towards the
    // short end.
    const double u = random.Uniform();
    const double place = random.Uniform() < 0.5 ? u * u : u;
    const int frames =
        options_.shortest + static_cast<int>(place * (options_.longest - options_.shortest + 1));
    const MotionBatch batch = Draw(&random, frames);
    losses_.step = step_ + 1;
    if (flow_stage()) {
      FlowStep(batch, &random);
      return;
    }
    planner_adam_->ZeroGrad();
    Descend(
        PlannerLoss(kinematics_, batch, model_->planner()->forward(batch.transition).trajectory));
    planner_adam_->Step(StageRate(options_.planner_rate, step_, planner_steps_), kMaxGradientNorm);
  }

  // The planner is frozen here: its trajectory and hidden state are inputs, not something to be
  // moved by the flow.
  void FlowStep(const MotionBatch& batch, Random* random) {
    for (auto& parameter : FrozenParameters()) parameter.set_requires_grad(false);
    flow_adam_->ZeroGrad();
    encoder_adam_->ZeroGrad();
    Descend(LikelihoodLoss(model_, batch, model_->BeginNear(batch.transition, batch.truth)));
    if (model_->config().key_loss) {
      // Longer than gamma too: a flow that was only ever unrolled over 30 frames may drift off
      // beyond them.
      const int frames = static_cast<int>(
          random->Integer(std::max(2, options_.rollout_frames / 2),
                          std::max(options_.rollout_frames,
                                   std::min(3 * options_.rollout_frames, options_.longest)) +
                              1));
      const int windows = std::max(4, options_.batch / 4 * options_.rollout_frames / frames);
      const ClipStore::Variation variation{.mirror = true, .drop_audio = 0.15};
      const MotionBatch sampled =
          train_.Draw(windows, model_->config().history_frames, frames, variation, random)
              .To(device_);
      Descend(RolloutLoss(model_, kinematics_, sampled,
                          model_->BeginNear(sampled.transition, sampled.truth),
                          model_->config().temperature));
    }
    const double rate = StageRate(options_.flow_rate, step_ - planner_steps_, flow_steps_);
    flow_adam_->Step(rate, kMaxGradientNorm);
    encoder_adam_->Step(rate, kMaxGradientNorm);
  }

  // Adds the gradient of the weighted sum; before a report, also each term's own, so that one that
  // vanishes or takes over is seen.
  void Descend(const LossTerms& terms) {
    const bool report = (step_ + 1) % options_.report_every == 0;
    torch::Tensor sum = torch::zeros({}, device_);
    for (const LossTerm& term : terms) {
      LossFigure& figure = losses_.terms[term.name];
      const double value = term.value.item<double>();
      figure.value = figure.value == 0 ? value : 0.98 * figure.value + 0.02 * value;
      if (report) figure.gradient = GradientNorm(term.weight * term.value);
      sum = sum + term.weight * term.value;
    }
    sum.backward();
  }

  std::vector<torch::Tensor> FrozenParameters() const {
    return model_->has_planner() ? model_->planner()->parameters() : std::vector<torch::Tensor>{};
  }
  double GradientNorm(const torch::Tensor& loss) const {
    std::vector<torch::Tensor> parameters;
    for (const auto& parameter : model_->parameters()) {
      if (parameter.requires_grad()) parameters.push_back(parameter);
    }
    double square = 0;
    for (const auto& gradient :
         torch::autograd::grad({loss}, parameters, /*grad_outputs=*/{}, /*retain_graph=*/true,
                               /*create_graph=*/false, /*allow_unused=*/true)) {
      if (gradient.defined()) square += gradient.square().sum().item<double>();
    }
    return std::sqrt(square);
  }

  // The flow's features are standardised on what the finished planner leaves over.
  void StartFlowStage() {
    torch::NoGradGuard no_grad;
    torch::manual_seed(options_.seed + 13);  // a run that is resumed here has not drawn before
    model_->eval();
    std::vector<MotionBatch> batches;
    for (int i = 0; i < kNormalisationBatches; ++i) {
      Random random(options_.seed + 7, static_cast<uint32_t>(i + 1));
      batches.push_back(Draw(&random, options_.rollout_frames + (i % 3) * 20));
    }
    if (model_->variety())
      FitVariety(train_, options_.batch, options_.longest, options_.seed, device_, &model_);
    NormaliseFeatures(batches, &model_);
    const MotionBatch& last = batches.back();
    const TransitionContext context = model_->BeginNear(last.transition, last.truth);
    const torch::Tensor features = model_->RelativeFeatures(last.features, last.truth, context);
    model_->InitialiseActNorm(Dequantise(model_, features), last.audio, last.has_audio, context);
  }

  std::vector<MotionBatch> PoseBatches() const {
    std::vector<MotionBatch> batches;
    for (int i = 0; i < kNormalisationBatches; ++i) {
      Random random(options_.seed + 3, static_cast<uint32_t>(i + 1));
      batches.push_back(train_.Draw(options_.batch, model_->config().history_frames,
                                    options_.rollout_frames, {.mirror = true}, &random));
    }
    return batches;
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
    state.metadata["options"] = options_.Fixed();
    state.metadata["planner_from"] = PlannerFrom();
    state.metadata["curves"] = curves_.Serialise();
    nlohmann::json losses;
    for (const auto& [name, figure] : losses_.terms) losses[name] = {figure.value, figure.gradient};
    state.metadata["losses"] = losses.dump();
    WriteSafetensors(StatePath(), state);
  }

  void Load() {
    Safetensors state = ReadSafetensors(StatePath());
    if (state.metadata.at("data") != train_.Hash()) {
      throw Error(ErrorCode::kFailedPrecondition, StatePath().string(),
                  "the run was started on other data (hash " + state.metadata.at("data") + ")");
    }
    if (state.metadata.at("options") != options_.Fixed()) {
      throw Error(ErrorCode::kFailedPrecondition, StatePath().string(),
                  "the run was started as\n  " + state.metadata.at("options") + "\nnot as\n  " +
                      options_.Fixed());
    }
    if (state.metadata["planner_from"] != PlannerFrom()) {
      throw Error(ErrorCode::kFailedPrecondition, StatePath().string(),
                  "the run was started from another --planner (hash " +
                      state.metadata["planner_from"] + ")");
    }
    ImportTensors(state, "model.", model_.get());
    flow_adam_->Import(state);
    encoder_adam_->Import(state);
    state.metadata["adam.steps"] = state.metadata.at("adam.planner_steps");
    planner_adam_->Import(state);
    step_ = std::stoll(state.metadata.at("step"));
    seconds_ = std::stod(state.metadata.at("seconds"));
    curves_.Restore(state.metadata.at("curves"));
    const auto losses = nlohmann::json::parse(state.metadata.at("losses"));
    for (const auto& [name, figure] : losses.items()) {
      losses_.terms[name] = {figure.at(0), figure.at(1)};
    }
  }

  void Finish() {
    const std::vector<ValidationRow> rows =
        Validate(model_, validation_, {10, 30, 60, 90}, kValidationWindows, true);
    nlohmann::json card =
        ModelCard(options_, planner_steps_, flow_steps_, train_.clips(), train_.Hash(), rows);
    if (!base_.is_null()) card["planner_from"] = base_;
    const std::string hash = SaveCheckpoint(options_.run / "checkpoint.safetensors", model_, card);
    std::printf("%s\n", card.dump(2).c_str());
    std::printf("checkpoint %s, content hash %s\n",
                (options_.run / "checkpoint.safetensors").string().c_str(), hash.c_str());
  }

  TrainOptions options_;
  nlohmann::json base_;  // whose planner this run started from: its hash and card
  ClipStore train_, validation_;
  TorchKinematics kinematics_;
  torch::Device device_;
  FlowModel model_{nullptr};
  std::unique_ptr<Adam> planner_adam_, flow_adam_, encoder_adam_;
  int64_t planner_steps_ = 0, flow_steps_ = 0;
  int64_t step_ = 0;
  double seconds_ = 0;
  LossRow losses_;
  Curves curves_;
};

}  // namespace

void Train(const TrainOptions& options) {
  options.Validate();
  Run run(options);
  run.Go();
}

}  // namespace choreo
