#pragma once

#include "client/authoring/keys/dance_keys.h"
#include "client/cli/report/written_dance.h"
#include "client/live/live_dance.h"

namespace choreo::cli {

/// Examines the received part of a live dance. `keys`: known from the beginning. `settings`: the
/// request; its beats become the beats danced to, unless its song's file has beats.
WrittenDance Examine(const live::LiveDance& live, const authoring::DanceKeys& keys,
                     DanceSettings settings);

}  // namespace choreo::cli
