#pragma once

#include "model/engine/transition_spec.h"

namespace choreo {

/// The controls of every frame, for a model that needs them all. A path that is not given leaves
/// the history's last root with its velocity, to the target's root or height; what has no end comes
/// to a stop. Factors that are not given are the model's first reference. The spec is valid
/// (ValidateSpec); the model names at least one reference.
Controls DenseControls(const TransitionSpec& spec, const ModelInfo& model);

}  // namespace choreo
