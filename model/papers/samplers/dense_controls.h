#pragma once

#include "model/plan/model_info.h"
#include "model/plan/transition_spec.h"

namespace choreo {

/// Fills in the controls of every frame, for a model that needs them all. A missing path starts at
/// the history's last root with its velocity, and leads to the target's root or height; without a
/// target it comes to a stop. Missing factors are the model's first reference. The spec must be
/// valid (ValidSpec), and the model must have a reference.
Controls DenseControls(const TransitionSpec& spec, const ModelInfo& model);

}  // namespace choreo
