#pragma once

#include <atomic>
#include <cstdint>

#include "client/choreo_client.h"

namespace choreo::bench {

/// Dances to `song` (kPcmFloat) in real time, over and over, while the next key pose is dragged: it
/// moves 30 times a second. Grants frames half a second ahead. Blocks until `over`. Returns the
/// number of received frames. Throws Error if the dance fails.
int64_t DanceEdited(const client::Client& client, const client::Audio& song, uint64_t seed,
                    const std::atomic<bool>& over);

}  // namespace choreo::bench
