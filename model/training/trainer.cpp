#include "model/training/trainer.h"

#include <torch/torch.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "model/core/error.h"
#include "model/flow/checkpoint.h"
#include "model/training/adam.h"
#include "model/training/fit_variety.h"
#include "model/training/losses.h"
#include "model/training/model_card.h"
#include "model/training/normalise.h"
#include "model/training/training_run.h"
#include "model/training/validation.h"

namespace choreo {
namespace {

constexpr int kNormalisationBatches = 24;
constexpr int kValidationWindows = 64;

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

NamedFigures FiguresOf(const std::vector<ValidationRow>& rows) {
  NamedFigures figures;
  for (const ValidationRow& row : rows) {
    const std::string n = std::to_string(row.frames);
    figures.insert(figures.end(), {{"planner_ratio_" + n, row.planner_m / row.interpolation_m},
                                   {"flow_ratio_" + n, row.flow_m / row.interpolation_m},
                                   {"val_nll_" + n, row.likelihood},
                                   {"mean_key_m_" + n, row.key_error_m}});
  }
  return figures;
}

class FlowRun : public TrainingRun {
 public:
  FlowRun(const TrainOptions& options, ClipStore train, ClipStore validation)
      : TrainingRun(options, train.Hash()),
        options_(options),
        train_(std::move(train)),
        validation_(std::move(validation)),
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
    NameLosses(LossTermNames());
    Open();
  }

 protected:
  int64_t total_steps() const override { return planner_steps_ + flow_steps_; }

  NamedFigures Validate() override {
    return FiguresOf(
        choreo::Validate(model_, validation_, {10, 30, 60, 90}, kValidationWindows, flow_stage()));
  }

  void TrainStep() override {
    if (step() == planner_steps_) StartFlowStage();
    Random random(options_.seed, static_cast<uint32_t>(step() + 1));
    torch::manual_seed(options_.seed + static_cast<uint64_t>(step()) * 1000003);
    model_->train();
    if (flow_stage() && model_->has_planner()) model_->planner()->eval();
    // Short transitions are common in use and cheap: half of the draws are quadratic towards the
    // short end.
    const double u = random.Uniform();
    const double place = random.Uniform() < 0.5 ? u * u : u;
    const int frames =
        options_.shortest + static_cast<int>(place * (options_.longest - options_.shortest + 1));
    const MotionBatch batch = Draw(&random, frames);
    if (flow_stage()) {
      FlowStep(batch, &random);
      return;
    }
    planner_adam_->ZeroGrad();
    Descend(
        PlannerLoss(kinematics_, batch, model_->planner()->forward(batch.transition).trajectory),
        model_->planner()->parameters());
    planner_adam_->Step(StageRate(options_.planner_rate, step(), planner_steps_), kMaxGradientNorm);
  }

  void Export(Safetensors* state) const override {
    ExportTensors(*model_, "model.", state);
    planner_adam_->Export(state);
    // Three optimisers share the step count's key; the flow's two always agree.
    const std::string planner_count = state->metadata["adam.steps"];
    encoder_adam_->Export(state);
    flow_adam_->Export(state);
    state->metadata["adam.planner_steps"] = planner_count;
    state->metadata["planner_from"] = PlannerFrom();
  }

  void Import(const Safetensors& content) override {
    Safetensors state = content;
    if (state.metadata["planner_from"] != PlannerFrom()) {
      throw Error(ErrorCode::kFailedPrecondition, options_.run.string(),
                  "the run was started from another --planner (hash " +
                      state.metadata["planner_from"] + ")");
    }
    ImportTensors(state, "model.", model_.get());
    flow_adam_->Import(state);
    encoder_adam_->Import(state);
    state.metadata["adam.steps"] = state.metadata.at("adam.planner_steps");
    planner_adam_->Import(state);
  }

  void Finish() override {
    if (flow_steps_ == 0) StartFlowStage();
    const std::vector<ValidationRow> rows =
        choreo::Validate(model_, validation_, {10, 30, 60, 90}, kValidationWindows, true);
    nlohmann::json card =
        ModelCard(options_, planner_steps_, flow_steps_, train_.clips(), train_.Hash(), rows,
                  "Trained on transitions of " + std::to_string(options_.shortest) + " to " +
                      std::to_string(options_.longest) +
                      " frames at 30 fps. The plan does not hear the music, the flow around it "
                      "does (if there is one), and plans are timed to the beats when they are "
                      "danced. Without keys it is calmer than real dancers. Feet may slide in "
                      "short transitions. What the data lacks (lying, acrobatics, props, "
                      "partners) it can't do.");
    if (!base_.is_null()) card["planner_from"] = base_;
    const std::string hash = SaveCheckpoint(options_.run / "checkpoint.safetensors", model_, card);
    std::printf("%s\n", card.dump(2).c_str());
    std::printf("checkpoint %s, content hash %s\n",
                (options_.run / "checkpoint.safetensors").string().c_str(), hash.c_str());
  }

 private:
  bool flow_stage() const { return step() >= planner_steps_; }

  MotionBatch Draw(Random* random, int frames) const {
    const int windows = WindowsOf(options_.batch, frames);
    const bool keys = model_->config().keys;
    const ClipStore::Variation variation{.mirror = true,
                                         .drop_key = keys ? 0.1 : 1.0,
                                         .drop_audio = 0.15,
                                         .partial_key = keys ? 0.1 : 0.0,
                                         .tempo = flow_stage() ? 0.0 : options_.tempo,
                                         .hold_history = 0.05};
    return train_.Draw(windows, model_->config().history_frames, frames, variation, random)
        .WithItsTurning()
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

  // The planner is frozen here: its trajectory and hidden state are inputs, not something to be
  // moved by the flow.
  void FlowStep(const MotionBatch& batch, Random* random) {
    for (auto& parameter : FrozenParameters()) parameter.set_requires_grad(false);
    flow_adam_->ZeroGrad();
    encoder_adam_->ZeroGrad();
    Descend(LikelihoodLoss(model_, batch, model_->BeginNear(batch.transition, batch.truth)),
            FreeParameters());
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
                          model_->config().temperature),
              FreeParameters());
    }
    const double rate = StageRate(options_.flow_rate, step() - planner_steps_, flow_steps_);
    flow_adam_->Step(rate, kMaxGradientNorm);
    encoder_adam_->Step(rate, kMaxGradientNorm);
  }

  std::vector<torch::Tensor> FrozenParameters() const {
    return model_->has_planner() ? model_->planner()->parameters() : std::vector<torch::Tensor>{};
  }
  std::vector<torch::Tensor> FreeParameters() const {
    std::vector<torch::Tensor> parameters;
    for (const auto& parameter : model_->parameters()) {
      if (parameter.requires_grad()) parameters.push_back(parameter);
    }
    return parameters;
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

  TrainOptions options_;
  nlohmann::json base_;  // whose planner this run started from: its hash and card
  ClipStore train_, validation_;
  TorchKinematics kinematics_;
  torch::Device device_;
  FlowModel model_{nullptr};
  std::unique_ptr<Adam> planner_adam_, flow_adam_, encoder_adam_;
  int64_t planner_steps_ = 0, flow_steps_ = 0;
};

}  // namespace

void Train(const TrainOptions& options) {
  options.Validate();
  FlowRun(options,
          ClipStore(options.data, options.splits,
                    options.with_validation ? Split::kTrainAndValidation : Split::kTrain),
          ClipStore(options.data, options.splits, Split::kValidation))
      .Go();
}

}  // namespace choreo
