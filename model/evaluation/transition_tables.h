#pragma once

#include <cstdint>
#include <vector>

#include "model/core/progress.h"
#include "model/evaluation/method.h"
#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"

namespace choreo {

/// Transitions between real poses of a set (paper F, Table 2 and the key columns of Table 1):
///   transitions_SET  every method: distances to the real dance and the field's metrics
///   keys_SET         every method: how far it misses keys, raw and as served
///   genres_SET       the model's ratio to interpolation, genre by genre (ratio_tables.h)
///   samples_SET      the same as served, at temperature 1, and of the best of some samples there
/// Methods of one table have one temperature, the same windows, music, seeds and post-processing.
/// `methods` has exactly one that is named kServed. Deterministic.
std::vector<Table> EvaluateTransitions(const ClipSet& set, const std::vector<Method>& methods,
                                       const EvalOptions& options, ProgressBar* progress);

/// How many frames that will dance.
int64_t CountTransitionFrames(const ClipSet& set, const std::vector<Method>& methods,
                              const EvalOptions& options);

}  // namespace choreo
