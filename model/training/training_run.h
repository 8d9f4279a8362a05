#pragma once

#include <torch/types.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/progress.h"
#include "model/core/random.h"
#include "model/core/safetensors.h"
#include "model/training/adam.h"
#include "model/training/clip_split.h"
#include "model/training/curves.h"
#include "model/training/loss_terms.h"
#include "model/training/trainer.h"

namespace choreo {

/// At least one of each, all of one skeleton.
struct TrainingClips {
  std::vector<PreparedClip> train, validation;
};

/// What every training run does, whatever it trains: steps one after another, reports, saves its
/// state and goes on from it exactly as if it had not been left. For that, each step draws from
/// generators of its own, keyed by its number: RandomOf(step()), and torch's.
class TrainingRun {
 public:
  virtual ~TrainingRun() = default;
  /// All steps that are left, then the last checkpoint; or as far as --stop-after.
  void Go();

 protected:
  /// Options and clips outlive the run.
  TrainingRun(const TrainOptions& options, const TrainingClips& clips);
  /// Has `network` trained, which is complete and outlives the run. Makes the run's folder and
  /// takes up what it holds. Throws Error(kFailedPrecondition) for a run that was started on other
  /// data or otherwise, or that is not to be resumed.
  void Open(torch::nn::Module* network);
  /// Notes what --from holds. Throws Error(kInvalidArgument, "--from") where its skeleton is not
  /// that of the clips.
  template <typename Checkpoint>
  void StartFrom(const Checkpoint& base) {
    if (!(base.model->skeleton() == train_.front().skeleton)) {
      throw InvalidArgument("--from",
                            options_.from.string() + " has another skeleton than these clips");
    }
    base_ = {{"hash", base.hash}, {"card", nlohmann::json::parse(base.card)}};
  }

  /// Before the first step of all.
  virtual void Prepare() {}
  /// Descends once or more; the optimiser's step follows.
  virtual void TrainStep() = 0;
  /// The optimiser has moved the network.
  virtual void AfterStep() {}
  /// On validation clips, by name.
  virtual NamedFigures Validate() = 0;
  /// The network and its optimiser, by name; and back.
  virtual void Export(Safetensors* state) const;
  virtual void Import(const Safetensors& state);
  /// Writes the checkpoint; returns its content hash.
  virtual std::string SaveModel(const std::filesystem::path& path, const nlohmann::json& card) = 0;
  /// What its card says that it can't do.
  virtual std::string Limits() const = 0;

  /// Adds the gradient of the weighted sum; before a report, also each term's own, so that one that
  /// vanishes or takes over is seen.
  void Descend(const LossTerms& terms);

  const TrainOptions& options() const { return options_; }
  int64_t step() const { return step_; }
  Random RandomOf(int64_t step) const {
    return Random(options_.seed, static_cast<uint32_t>(step + 1));
  }

 private:
  std::filesystem::path StatePath() const { return options_.run / "state.safetensors"; }
  /// With a checkpoint, so that a run can be judged and used before it ends.
  void Report(ProgressBar* progress);
  /// What a checkpoint says of itself: data and their terms, the command, figures on validation
  /// clips, limits, and what it went on from, whose terms bind it, too.
  nlohmann::json Card() const;
  /// Of what the run went on from; empty: from scratch.
  std::string BaseHash() const;
  std::string WriteCheckpoint();
  void Save();
  void Load();

  const TrainOptions& options_;
  const std::vector<PreparedClip>& train_;
  std::string data_hash_;
  nlohmann::json base_;  // what the run went on from: its hash and card
  torch::nn::Module* network_ = nullptr;
  std::unique_ptr<Adam> adam_;
  int64_t step_ = 0;
  double seconds_ = 0;
  LossFigures losses_;
  NamedFigures figures_;  // of the last report
  Curves curves_;
};

/// A run of the class `Run`, which is made of options and clips.
template <typename Run, typename Options>
void TrainBy(const Options& options) {
  options.Validate();
  const TrainingClips clips = {LoadClips(options.data, options.splits, kTrainGroup),
                               LoadClips(options.data, options.splits, kValidationGroup)};
  Run(options, clips).Go();
}

/// Of what is drawn for validation: the same at every run.
inline constexpr uint64_t kValidationSeed = 20240607;

/// How many windows of so many frames make up a step: `batch` of 60 frames or as many frames of
/// longer ones, at most three times as many short ones, at least 8.
int WindowsOf(int batch, int frames);

}  // namespace choreo
