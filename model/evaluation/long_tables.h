#pragma once

#include <cstdint>
#include <vector>

#include "model/core/progress.h"
#include "model/evaluation/method.h"
#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"

namespace choreo {

/// Long dances beside the clips of a set:
///   long_SET       with keys each 2 s and without: drift, freezing, explosion, limbs, keys
///   beats_SET      kinematic beats on music beats, against the same dances scored on the set's
///                  other songs (chance); keys at equal intervals and on beats (paper F, Table 4).
///                  Sets with music alone
///   influence_SET  how far a dance goes from itself with another seed, song, or none
/// Deterministic. Empty for EvalOptions::long_seeds 0.
std::vector<Table> EvaluateLongDances(const ClipSet& set, StepEngine& engine,
                                      const EvalOptions& options, ProgressBar* progress);

/// How many frames that will dance.
int64_t CountLongFrames(const ClipSet& set, const ModelInfo& model, const EvalOptions& options);

}  // namespace choreo
