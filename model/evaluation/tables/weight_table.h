#pragma once

#include <vector>

#include "model/evaluation/evaluation.h"
#include "model/evaluation/tables/liveliness_figures.h"

namespace choreo {

/// The table weight_SET: whether dancers seem to have weight (metrics/balance.h, contrast.h).
/// Compares them with real motion, with the training clips (what is attainable), and with real
/// motion through footwork (what footwork alone changes). `keyed`: the dances of `real`, seed after
/// seed. No table without real motion or for a skeleton of unknown mass.
std::vector<Table> WeightTable(const Evaluation& evaluation, const Method& method,
                               const LivelinessDances& real, const LivelinessDances& footwork,
                               const std::vector<LivelinessDances>& keyed,
                               const LivelinessDances& free);

}  // namespace choreo
