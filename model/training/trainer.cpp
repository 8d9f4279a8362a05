#include "model/training/trainer.h"

#include <torch/torch.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "model/core/error.h"
#include "model/flow/checkpoint.h"
#include "model/training/adam.h"
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
    figures.insert(figures.end(), {{"flow_ratio_" + n, row.flow_m / row.interpolation_m},
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
    if (options.from.empty()) {
      NormaliseAudio(train_, &model_);
    } else {
      TakeModel();
    }
    model_->to(device_);
    adam_ = std::make_unique<Adam>(*model_, "");
    NameLosses(LossTermNames());
    Open();
  }

 protected:
  int64_t total_steps() const override { return options_.steps; }

  NamedFigures Validate() override {
    return FiguresOf(choreo::Validate(model_, validation_, {10, 30, 60, 90}, kValidationWindows));
  }

  void TrainStep() override {
    if (step() == 0 && options_.from.empty()) Standardise();
    Random random(options_.seed, static_cast<uint32_t>(step() + 1));
    torch::manual_seed(options_.seed + static_cast<uint64_t>(step()) * 1000003);
    model_->train();
    // Short transitions are common in use and cheap: half of the draws are quadratic towards the
    // short end.
    const double u = random.Uniform();
    const double place = random.Uniform() < 0.5 ? u * u : u;
    const MotionBatch batch =
        Draw(&random, options_.shortest +
                          static_cast<int>(place * (options_.longest - options_.shortest + 1)));
    adam_->ZeroGrad();
    Descend(LikelihoodLoss(model_, batch, model_->Begin(batch.transition)), model_->parameters());
    if (model_->config().key_loss) {
      const MotionBatch sampled = DrawRollout(&random);
      Descend(RolloutLoss(model_, kinematics_, sampled, model_->Begin(sampled.transition),
                          model_->config().temperature),
              model_->parameters());
    }
    adam_->Step(StageRate(options_.rate, step(), options_.steps), kMaxGradientNorm);
  }

  void Export(Safetensors* state) const override {
    ExportTensors(*model_, "model.", state);
    adam_->Export(state);
  }
  void Import(const Safetensors& state) override {
    ImportTensors(state, "model.", model_.get());
    adam_->Import(state);
  }

  void Finish() override {
    nlohmann::json card =
        ModelCard(options_, train_.clips(), train_.Hash(), Validate(),
                  "Trained on transitions of " + std::to_string(options_.shortest) + " to " +
                      std::to_string(options_.longest) +
                      " frames at 30 fps. Feet may slide in short transitions. What the data lacks "
                      "(lying, acrobatics, props, partners) it can't do.");
    if (!base_.is_null()) card["from"] = base_;
    const std::string hash = SaveCheckpoint(options_.run / "checkpoint.safetensors", model_, card);
    std::printf("%s\n", card.dump(2).c_str());
    std::printf("checkpoint %s, content hash %s\n",
                (options_.run / "checkpoint.safetensors").string().c_str(), hash.c_str());
  }

 private:
  MotionBatch Draw(Random* random, int frames) const {
    const int windows = WindowsOf(options_.batch, frames);
    const bool keys = model_->config().keys;
    const ClipStore::Variation variation{.mirror = true,
                                         .drop_key = keys ? 0.1 : 1.0,
                                         .drop_audio = 0.15,
                                         .partial_key = keys ? 0.1 : 0.0,
                                         .hold_history = 0.05};
    return train_.Draw(windows, model_->config().history_frames, frames, variation, random)
        .To(device_);
  }

  // Longer than gamma too: a flow that was only ever unrolled over 30 frames may drift off beyond
  // them.
  MotionBatch DrawRollout(Random* random) const {
    const int gamma = options_.rollout_frames;
    const int frames = static_cast<int>(random->Integer(
        std::max(2, gamma / 2), std::max(gamma, std::min(3 * gamma, options_.longest)) + 1));
    return train_
        .Draw(std::max(4, options_.batch / 4 * gamma / frames), model_->config().history_frames,
              frames, {.mirror = true, .drop_audio = 0.15}, random)
        .To(device_);
  }

  void TakeModel() {
    const Safetensors content = ReadSafetensors(options_.from);
    const Checkpoint base = ParseCheckpoint(content, options_.from.string());
    if (!(base.model->skeleton() == model_->skeleton())) {
      throw InvalidArgument("--from",
                            options_.from.string() + " has another skeleton than these clips");
    }
    ImportTensors(content, "", model_.get());
    base_ = {{"hash", base.hash}, {"card", nlohmann::json::parse(base.card)}};
  }

  // Features and ActNorm, by the data.
  void Standardise() {
    torch::NoGradGuard no_grad;
    torch::manual_seed(options_.seed + 13);
    model_->eval();
    std::vector<MotionBatch> batches;
    for (int i = 0; i < kNormalisationBatches; ++i) {
      Random random(options_.seed + 7, static_cast<uint32_t>(i + 1));
      batches.push_back(Draw(&random, options_.rollout_frames + (i % 3) * 20));
    }
    NormaliseFeatures(batches, &model_);
    const MotionBatch& last = batches.back();
    model_->InitialiseActNorm(Dequantise(model_, last.features), last.audio, last.has_audio,
                              model_->Begin(last.transition));
  }

  TrainOptions options_;
  nlohmann::json base_;  // what this run started from: its hash and card
  ClipStore train_, validation_;
  TorchKinematics kinematics_;
  torch::Device device_;
  FlowModel model_{nullptr};
  std::unique_ptr<Adam> adam_;
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
