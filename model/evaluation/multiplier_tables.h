#pragma once

#include <vector>

#include "model/core/progress.h"
#include "model/evaluation/control_course.h"

namespace choreo {

/// How the speed of each part follows its velocity factors, on the real path between real poses:
///   multipliers_SET  the real dance's factors times 0.5, 1 and 1.5, over that dance's speeds
///   constant_SET     the model's first reference times 0.5, 1 and 1.5 in every frame, over that
///                    reference
/// Means over windows and frames. Who takes no factors has one row in each. Deterministic.
std::vector<Table> EvaluateMultipliers(const ClipSet& set, const ModelInfo& model,
                                       const std::vector<ControlledWay>& ways,
                                       const EvalOptions& options, ProgressBar* progress);

/// How many frames that will dance.
int64_t CountMultiplierFrames(const ClipSet& set, const ModelInfo& model,
                              const std::vector<ControlledWay>& ways, const EvalOptions& options);

}  // namespace choreo
