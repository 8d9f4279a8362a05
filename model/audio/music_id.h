#pragma once

#include <cstdint>
#include <span>

namespace choreo {

/// Identifies music: a hash of its first seconds, rounded to 16 bits, so that it does not depend on
/// how much of the song is danced to. `mono`: at 22 050 Hz. Never 0.
uint64_t MusicId(std::span<const float> mono);

}  // namespace choreo
