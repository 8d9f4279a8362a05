#pragma once

#include "model/engine/step_engine.h"

namespace choreo {

/// Dances short transitions in free slots of `engine`, alone and together, and forgets them:
/// whatever is set up when it is first used is there when the first client comes, and the engine's
/// cost() is known. Throws what the engine throws.
void WarmUp(StepEngine& engine);

}  // namespace choreo
