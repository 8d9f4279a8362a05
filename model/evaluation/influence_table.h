#pragma once

#include <cstdint>

#include "model/core/progress.h"
#include "model/evaluation/method.h"
#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"

namespace choreo {

/// influence_SET: how far a dance of 20 s goes from itself with another seed, song, or none; mean
/// distance of all joints, cm, with keys each 2 s and without. Deterministic.
Table EvaluateInfluence(const ClipSet& set, StepEngine& engine, const EvalOptions& options,
                        ProgressBar* progress);

/// How many frames that will dance.
int64_t CountInfluenceFrames(const ClipSet& set, const ModelInfo& model,
                             const EvalOptions& options);

}  // namespace choreo
