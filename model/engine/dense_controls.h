#pragma once

#include "model/engine/step_engine.h"

namespace choreo {

/// The controls of every frame, for a model that needs them all: what the spec leaves open is
/// filled.
///
/// A path that is not given is a smooth curve that leaves the history's last root with its
/// velocity, to the target's root or, of a target that leaves the place open, to its height; what
/// has no end comes to a stop. Factors that are not given are the model's first reference. What is
/// given stays as it is.
/// The spec is valid (ValidateSpec); the model names at least one reference.
Controls DenseControls(const TransitionSpec& spec, const ModelInfo& model);

}  // namespace choreo
