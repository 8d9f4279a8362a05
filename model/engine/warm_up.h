#pragma once

#include "model/engine/step_engine.h"

namespace choreo {

/// Dances one short transition in a free slot of `engine`, and forgets it: whatever is set up when
/// it is first used is there when the first client comes. Throws what the engine throws.
void WarmUp(StepEngine& engine);

}  // namespace choreo
