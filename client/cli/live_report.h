#pragma once

#include "client/authoring/dance_keys.h"
#include "client/cli/written_dance.h"
#include "client/live/live_dance.h"

namespace choreo::cli {

/// A live dance, as far as it was danced. `keys`: those known from the beginning; `asked` gets the
/// beats that were danced to, unless its song's file tells them.
WrittenDance Examine(const live::LiveDance& live, const authoring::DanceKeys& keys, Asked asked);

}  // namespace choreo::cli
