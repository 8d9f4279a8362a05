#pragma once

#include "model/engine/step_engine.h"

namespace choreo {

/// The controls of every frame, for a model that needs them all: what the spec leaves open is
/// filled.
///
/// A path that is not given is a smooth curve that leaves the history's last root with its
/// velocity, to the target's root (without one, to a stop). A given path is bent at its start to
/// leave from the history's root, and at its end to the target's root where it misses it: the key
/// wins. Factors that are not given are the model's first reference.
/// The spec is valid (ValidateSpec); the model names at least one reference.
Controls DenseControls(const TransitionSpec& spec, const ModelInfo& model);

}  // namespace choreo
