#pragma once

#include <vector>

#include "model/flow/flow_model.h"
#include "model/training/clip_store.h"

/// Measures training data and standardises a model by it. Each leaves the model's other
/// normalisations as they are.
namespace choreo {

/// Music rows of all clips.
void NormaliseAudio(const ClipStore& clips, FlowModel* model);

/// The flow's features. Spreads have floors, so that constant joints can't make the density
/// unbounded.
void NormaliseFeatures(const std::vector<MotionBatch>& batches, FlowModel* model);

}  // namespace choreo
