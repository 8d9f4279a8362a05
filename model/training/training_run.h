#pragma once

#include <torch/types.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "model/core/progress.h"
#include "model/core/random.h"
#include "model/core/safetensors.h"
#include "model/training/adam.h"
#include "model/training/clip_store.h"
#include "model/training/curves.h"
#include "model/training/losses.h"
#include "model/training/train_options.h"

namespace choreo {

/// What every training run does, whatever it trains: steps one after another, reports, saves its
/// state and goes on from it exactly as if it had not been left. For that, each step draws from
/// generators of its own, keyed by its number: RandomOf(step()), and torch's.
class TrainingRun {
 public:
  virtual ~TrainingRun() = default;
  /// All steps that are left, then the last checkpoint; or as far as --stop-after.
  void Go();

 protected:
  /// `train`, the clips that train, outlive the run.
  TrainingRun(const TrainOptions& options, const ClipStore& train);
  /// Has `network` trained, which is complete and outlives the run. Makes the run's folder and
  /// takes up what it holds. Throws Error(kFailedPrecondition) for a run that was started on other
  /// data or otherwise, or that is not to be resumed.
  void Open(torch::nn::Module* network);
  /// Notes what --from holds. Throws Error(kInvalidArgument, "--from") where its skeleton is not
  /// that of the clips.
  template <typename Checkpoint>
  void StartFrom(const Checkpoint& base) {
    StartFrom(base.model->skeleton(), base.hash, base.card);
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

  /// Terms that come later, so that a run's curves have their columns from the start.
  void NameLosses(const std::vector<std::string>& names);
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
  void StartFrom(const Skeleton& skeleton, const std::string& hash, const std::string& card);
  /// With a checkpoint, so that a run can be judged and used before it ends.
  void Report(ProgressBar* progress);
  std::string WriteCheckpoint();
  void Save();
  void Load();

  TrainOptions options_;
  const ClipStore& train_;
  std::string data_hash_;
  nlohmann::json base_;  // what the run went on from: its hash and card
  torch::nn::Module* network_ = nullptr;
  std::unique_ptr<Adam> adam_;
  int64_t step_ = 0;
  double seconds_ = 0;
  LossRow losses_;
  NamedFigures figures_;  // of the last report
  Curves curves_;
};

/// A run of the class `Run`, which is made of options, the clips that train and those that
/// validate.
template <typename Run>
void TrainBy(const TrainOptions& options) {
  options.Validate();
  std::set<std::string> groups = {kTrainGroup};
  if (options.with_validation) groups.insert(kValidationGroup);
  const ClipStore train(options.data, options.splits, groups);
  const ClipStore validation(options.data, options.splits, {kValidationGroup});
  Run(options, train, validation).Go();
}

/// How many windows of so many frames make up a step: `batch` of 60 frames or as many frames of
/// longer ones, at most three times as many short ones, at least 8.
int WindowsOf(int batch, int frames);

}  // namespace choreo
