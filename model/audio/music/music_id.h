#pragma once

#include <cstdint>
#include <span>

namespace choreo {

/// Identifies music by a hash of its first seconds, rounded to 16 bits, so that the id does not
/// depend on how much of the song is used. `mono`: at 22 050 Hz. Never 0.
uint64_t MusicId(std::span<const float> mono);

}  // namespace choreo
