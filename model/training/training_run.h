#pragma once

#include <torch/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "model/core/safetensors.h"
#include "model/training/curves.h"
#include "model/training/losses.h"
#include "model/training/report_row.h"
#include "model/training/train_options.h"

namespace choreo {

/// What every training run does, whatever it trains: steps one after another, reports, saves its
/// state and goes on from it exactly as if it had not been left. For that, each step has to draw
/// from a generator of its own, keyed by its number.
class TrainingRun {
 public:
  virtual ~TrainingRun() = default;
  /// All steps that are left, then Finish; or as far as --stop-after.
  void Go();

 protected:
  /// `data_hash`: which clips train.
  TrainingRun(const TrainOptions& options, std::string data_hash);
  /// Makes the run's folder and takes up what it holds. Called when a subclass is complete. Throws
  /// Error(kFailedPrecondition) for a run that was started on other data or otherwise, or that is
  /// not to be resumed.
  void Open();

  virtual int64_t total_steps() const = 0;
  virtual void TrainStep() = 0;
  /// On validation clips, by name.
  virtual NamedFigures Validate() = 0;
  /// The model and its optimisers, by name; and back.
  virtual void Export(Safetensors* state) const = 0;
  virtual void Import(const Safetensors& state) = 0;
  /// Writes the checkpoint.
  virtual void Finish() = 0;
  /// Written at every report, so that a run can be judged and used before it ends. By default
  /// nothing.
  virtual void WriteInterim() {}

  /// Terms that a later stage brings along, so that a run's curves have their columns from the
  /// start.
  void NameLosses(const std::vector<std::string>& names);
  /// Adds the gradient of the weighted sum; before a report, also each term's own, so that one that
  /// vanishes or takes over is seen.
  void Descend(const LossTerms& terms, const std::vector<torch::Tensor>& parameters);

  const TrainOptions& options() const { return options_; }
  int64_t step() const { return step_; }

 private:
  std::filesystem::path StatePath() const { return options_.run / "state.safetensors"; }
  void Report();
  void Save();
  void Load();

  TrainOptions options_;
  std::string data_hash_;
  int64_t step_ = 0;
  double seconds_ = 0;
  LossRow losses_;
  Curves curves_;
};

/// Gradients are cut to this norm.
inline constexpr double kMaxGradientNorm = 1.0;

/// How many windows of so many frames make up a step: `batch` of 60 frames or as many frames of
/// longer ones, at most three times as many short ones, at least 8.
int WindowsOf(int batch, int frames);

/// The learning rate of a stage's step: warm-up, then a cosine to a twentieth of the peak.
double StageRate(double peak, int64_t step, int64_t steps);

}  // namespace choreo
