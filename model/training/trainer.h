#pragma once

#include "model/training/train_options.h"

/// Trains a network, showing a progress bar. Writes run/state.safetensors (resumable to the bit
/// after a kill at any time), curves.csv, plots of it, and checkpoint.safetensors with its card, at
/// each report and at the end. Throws Error(kInvalidArgument) naming the option that can't be used.
namespace choreo {

/// Paper F's flow: the presets `paper` and `ablation`.
void TrainFlow(const TrainOptions& options);
/// Paper C's network, on a curriculum of lengths.
void TrainControllers(const TrainOptions& options);
/// The continuous flow. Its checkpoint has the moving average of the weights.
void TrainContinuousFlow(const TrainOptions& options);

}  // namespace choreo
