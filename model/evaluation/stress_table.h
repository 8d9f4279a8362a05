#pragma once

#include "model/core/progress.h"
#include "model/evaluation/method.h"
#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"

namespace choreo {

/// Paper F, Section 5.2: where its model failed. Onto a lying pose in 30 frames and fewer, and onto
/// a key that is almost the pose that the dancer has. Says whether the stream would warn that the
/// interval is too short (RequiredSpeed::TooFast), whether the dancer freezes in between, and how
/// hard the way is; beside real motion of such lengths, and the model where no key is asked.
/// Histories are real ones of the set.
Table EvaluateStress(const ClipSet& set, StepEngine& engine, const EvalOptions& options);

}  // namespace choreo
