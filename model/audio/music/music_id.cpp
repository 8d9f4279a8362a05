#include "model/audio/music/music_id.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/audio/beats/beats.h"
#include "model/audio/signal/format.h"

namespace choreo {

uint64_t MusicId(std::span<const float> mono) {
  // Dancing to any part decodes at least this much.
  constexpr size_t kHeard = size_t{kTempoWindowSeconds} * kModelSampleRate;
  std::vector<int16_t> rounded;
  for (const float sample : mono.first(std::min(mono.size(), kHeard)))
    rounded.push_back(static_cast<int16_t>(std::lround(32767 * std::clamp(sample, -1.0F, 1.0F))));
  return std::max<uint64_t>(1, XXH64(rounded.data(), rounded.size() * sizeof(int16_t), 0));
}

}  // namespace choreo
