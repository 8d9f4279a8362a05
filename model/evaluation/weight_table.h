#pragma once

#include <vector>

#include "model/evaluation/evaluation.h"
#include "model/evaluation/lively_figures.h"

namespace choreo {

/// weight_SET: whether she has weight (metrics/balance.h, contrast.h), beside real motion and that
/// of the training clips' dancers, which says what can be reached. `keyed`: the same dances as
/// `real`, one after the other, by seed. No table where there is no real motion, or for a skeleton
/// whose mass is unknown.
std::vector<Table> WeightTable(const Evaluation& evaluation, const Method& method,
                               const LivelyDances& real, const std::vector<LivelyDances>& keyed,
                               const LivelyDances& free);

}  // namespace choreo
