#pragma once

#include <vector>

#include "model/core/progress.h"
#include "model/evaluation/control_course.h"

namespace choreo {

/// Root paths that nobody danced, between real poses: straight on at constant speed, on the spot
/// (the key is moved there), and a bow; beside the real ones. No velocity factors are asked for.
/// Of the ways with keys that take a path: how much feet skate, how well key and path are met.
/// Named drawn_SET. Deterministic.
Table EvaluateDrawnPaths(const ClipSet& set, const ModelInfo& model,
                         const std::vector<ControlledWay>& ways, const EvalOptions& options,
                         ProgressBar* progress);

/// How many frames that will dance.
int64_t CountDrawnFrames(const ClipSet& set, const ModelInfo& model,
                         const std::vector<ControlledWay>& ways, const EvalOptions& options);

}  // namespace choreo
