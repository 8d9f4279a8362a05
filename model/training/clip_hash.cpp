#include "model/training/clip_hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstdio>

namespace choreo {

std::string HashOfClips(std::span<const PreparedClip> clips, std::string_view before) {
  XXH64_hash_t hash = before.empty() ? 0 : XXH3_64bits(before.data(), before.size());
  for (const PreparedClip& clip : clips) {
    hash = XXH3_64bits_withSeed(clip.name.data(), clip.name.size(), hash);
    for (const Pose& pose : clip.motion.frames) {
      hash = XXH3_64bits_withSeed(pose.root_position.data(), 3 * sizeof(double), hash);
      hash = XXH3_64bits_withSeed(
          pose.rotations.data(), static_cast<size_t>(pose.rotations.size()) * sizeof(double), hash);
    }
  }
  char hex[17];
  std::snprintf(hex, sizeof(hex), "%016llx", static_cast<unsigned long long>(hash));
  return hex;
}

}  // namespace choreo
