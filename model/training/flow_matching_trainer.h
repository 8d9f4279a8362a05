#pragma once

#include "model/training/train_options.h"

namespace choreo {

/// Trains the continuous flow, as Train does the others (model/training/trainer.h): resumable after
/// a kill at any time, to the bit. Its checkpoint has the moving average of the weights.
void TrainContinuousFlow(const TrainOptions& options);

}  // namespace choreo
