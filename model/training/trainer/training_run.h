#pragma once

#include <torch/types.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/files/safetensors.h"
#include "model/core/numbers/random.h"
#include "model/core/running/progress.h"
#include "model/training/clips/clip_split.h"
#include "model/training/trainer/adam.h"
#include "model/training/trainer/curves.h"
#include "model/training/trainer/loss_terms.h"
#include "model/training/trainer/trainer.h"

namespace choreo {

/// The clips of a run: at least one in each group, all on one skeleton.
struct TrainingClips {
  std::vector<PreparedClip> train, validation;
};

/// The base of all training runs. Takes steps, reports, saves its state and resumes to the bit. For
/// that, each step has its own random generators, seeded by its number: RandomOf(step()) and
/// torch's.
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
  /// Records the checkpoint of --from for the card. Throws Error(kInvalidArgument, "--from") if its
  /// skeleton is not the clips'.
  template <typename Checkpoint>
  void StartFrom(const Checkpoint& base) {
    if (!(base.model->skeleton() == train_.front().skeleton)) {
      throw InvalidArgument("--from",
                            options_.from.string() + " has another skeleton than these clips");
    }
    base_ = {{"hash", base.hash}, {"card", nlohmann::json::parse(base.card)}};
  }

  /// Called before the very first step.
  virtual void Prepare() {}
  /// Must call Descend at least once. The optimiser's step follows.
  virtual void TrainStep() = 0;
  /// Called after the optimiser has changed the network.
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

  /// Adds the gradient of the weighted sum. Before a report, also measures each term's own
  /// gradient, to show terms that vanish or dominate.
  void Descend(const LossTerms& terms);

  const TrainOptions& options() const { return options_; }
  int64_t step() const { return step_; }
  Random RandomOf(int64_t step) const {
    return Random(options_.seed, static_cast<uint32_t>(step + 1));
  }

 private:
  std::filesystem::path StatePath() const { return options_.run / "state.safetensors"; }
  /// Reports and writes a checkpoint, so that a run can be judged and used before its end.
  void Report(ProgressBar* progress);
  /// A checkpoint's card: the data and their terms, the command, validation figures, limits, and
  /// the base model, whose terms also apply.
  nlohmann::json Card() const;
  /// Hash of the base checkpoint; empty: from scratch.
  std::string BaseHash() const;
  void WriteCheckpoint();
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
  std::string hash_;      // content hash of the checkpoint; empty: this process wrote none
  Curves curves_;
};

/// Loads the clips and makes a run of class `Run`.
/// `settings`: whatever else it takes.
template <typename Run, typename Options, typename... Settings>
void TrainBy(const Options& options, const Settings&... settings) {
  options.Check();
  const TrainingClips clips = {LoadClips(options.data, options.splits, kTrainGroup),
                               LoadClips(options.data, options.splits, kValidationGroup)};
  Run(options, clips, settings...).Go();
}

/// The seed of validation, the same in every run.
inline constexpr uint64_t kValidationSeed = 20240607;

/// The number of windows of this length per step: `batch` at 60 frames, and otherwise as many as
/// have the same number of frames in total, but at least 8 and at most three times `batch`.
int WindowsOf(int batch, int frames);

}  // namespace choreo
