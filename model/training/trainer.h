#pragma once

#include "model/training/train_options.h"

namespace choreo {

/// Trains, showing a progress bar; writes run/state.safetensors (resumable after a kill at any
/// time), run/curves.csv, run/curves.png and, at the end, run/checkpoint.safetensors with its card.
void Train(const TrainOptions& options);

}  // namespace choreo
