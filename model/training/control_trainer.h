#pragma once

#include "model/training/train_options.h"

namespace choreo {

/// Trains the controllers network as Train (trainer.h) does the flow: first its plan alone, then
/// everything, each on its curriculum of lengths.
void TrainControllers(const TrainOptions& options);

}  // namespace choreo
