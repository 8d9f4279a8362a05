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

/// The clips, at least one in each set, all on one skeleton.
struct TrainingClips {
  std::vector<PreparedClip> train, validation;
};

/// The common part of all training: takes steps, reports, saves its state and resumes exactly as if
/// never interrupted. For that, each step draws from its own generators, keyed by its number:
/// RandomOf(step()), and torch's.
class TrainingRun {
 public:
  virtual ~TrainingRun() = default;
  /// Takes all remaining steps and writes the last checkpoint, or stops at --stop-after.
  void Go();

 protected:
  /// Options and clips must outlive the run.
  TrainingRun(const TrainOptions& options, const TrainingClips& clips);
  /// Trains `network`, which must be complete and outlive the run. Creates the run's folder and
  /// loads any state in it. Throws Error(kFailedPrecondition) if the run was started with other
  /// data or options, or must not be resumed.
  void Open(torch::nn::Module* network);
  /// Records the checkpoint of --from. Throws Error(kInvalidArgument, "--from") if its skeleton is
  /// not the clips'.
  template <typename Checkpoint>
  void StartFrom(const Checkpoint& base) {
    if (!(base.model->skeleton() == train_.front().skeleton)) {
      throw InvalidArgument("--from",
                            options_.from.string() + " has another skeleton than these clips");
    }
    base_ = {{"hash", base.hash}, {"card", nlohmann::json::parse(base.card)}};
  }

  /// Runs before the very first step.
  virtual void Prepare() {}
  /// Calls Descend at least once; the optimiser's step follows.
  virtual void TrainStep() = 0;
  /// Runs after the optimiser has changed the network.
  virtual void AfterStep() {}
  /// Figures on validation clips, by name.
  virtual NamedFigures Validate() = 0;
  /// Saves network and optimiser by name; Import restores them.
  virtual void Export(Safetensors* state) const;
  virtual void Import(const Safetensors& state);
  /// Writes the checkpoint; returns its content hash.
  virtual std::string SaveModel(const std::filesystem::path& path, const nlohmann::json& card) = 0;
  /// The model's limits, for its card.
  virtual std::string Limits() const = 0;

  /// Adds the gradient of the weighted sum; before a report also measures each term's own, to show
  /// terms that vanish or dominate.
  void Descend(const LossTerms& terms);

  const TrainOptions& options() const { return options_; }
  int64_t step() const { return step_; }
  Random RandomOf(int64_t step) const {
    return Random(options_.seed, static_cast<uint32_t>(step + 1));
  }

 private:
  std::filesystem::path StatePath() const { return options_.run / "state.safetensors"; }
  /// Reports, and writes a checkpoint, so that a run can be judged and used before it ends.
  void Report(ProgressBar* progress);
  /// A checkpoint's card: data and their terms, the command, validation figures, limits, and the
  /// base model, whose terms apply, too.
  nlohmann::json Card() const;
  /// Hash of the base checkpoint; empty: from scratch.
  std::string BaseHash() const;
  std::string WriteCheckpoint();
  void Save();
  void Load();

  const TrainOptions& options_;
  const std::vector<PreparedClip>& train_;
  std::string data_hash_;
  nlohmann::json base_;  // the base checkpoint's hash and card
  torch::nn::Module* network_ = nullptr;
  std::unique_ptr<Adam> adam_;
  int64_t step_ = 0;
  double seconds_ = 0;
  LossFigures losses_;
  NamedFigures figures_;  // from the last report
  Curves curves_;
};

/// Makes a run of class `Run` from options and clips.
template <typename Run, typename Options>
void TrainBy(const Options& options) {
  options.Validate();
  const TrainingClips clips = {LoadClips(options.data, options.splits, kTrainGroup),
                               LoadClips(options.data, options.splits, kValidationGroup)};
  Run(options, clips).Go();
}

/// The seed of validation, the same in every run.
inline constexpr uint64_t kValidationSeed = 20240607;

/// Windows of this length per step: `batch` at 60 frames; fewer longer ones with as many frames in
/// total; at most three times as many short ones; at least 8.
int WindowsOf(int batch, int frames);

}  // namespace choreo
