#pragma once

#include "model/flow/flow_model.h"
#include "model/training/clip_store.h"

namespace choreo {

/// Fits the model's variety (flow/variety.h) to what its planner leaves over on `clips`, with and
/// without keys, in transitions of up to `longest` frames, `batch` windows of each.
void FitVariety(const ClipStore& clips, int batch, int longest, uint64_t seed, torch::Device device,
                FlowModel* model);

}  // namespace choreo
