#pragma once

#include <vector>

#include "model/evaluation/evaluation.h"
#include "model/evaluation/lively_figures.h"

namespace choreo {

/// weight_SET: whether dancers have weight (metrics/balance.h, contrast.h), beside real motion and
/// the training clips' dancers, who show what is attainable, and real motion through footwork,
/// which shows what footwork alone changes. `keyed`: the dances of `real`, seed after seed. No
/// table without real motion or for a skeleton of unknown mass.
std::vector<Table> WeightTable(const Evaluation& evaluation, const Method& method,
                               const LivelyDances& real, const LivelyDances& footwork,
                               const std::vector<LivelyDances>& keyed, const LivelyDances& free);

}  // namespace choreo
