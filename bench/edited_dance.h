#pragma once

#include <atomic>
#include <cstdint>

#include "client/choreo_client.h"

namespace choreo::bench {

/// Dances to `song` (kPcmFloat) in real time, over and over, while somebody drags the next key
/// pose: it moves 30 times a second. Frames are granted half a second ahead. Blocks until `over`;
/// returns how many frames came. Throws Error if the dance fails.
int64_t DanceEdited(const client::Client& client, const client::Audio& song, uint64_t seed,
                    const std::atomic<bool>& over);

}  // namespace choreo::bench
