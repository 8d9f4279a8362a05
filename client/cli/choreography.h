#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/choreo_client.h"
#include "client/cli/pose_library.h"
#include "model/core/passage.h"

namespace choreo::cli {

/// What to compose: key poses for a dance of `seconds`.
struct CompositionRequest {
  double seconds = 0;
  std::vector<double> beats = {};      ///< seconds, ascending; may be empty
  std::vector<Passage> passages = {};  ///< of the music, that come back
  uint64_t seed = 0;
  /// The seed of a dance whose way over the floor is kept to, so that a formation stays one.
  std::optional<uint64_t> way = {};
  /// Where the last key stands, at most `seconds`; none: wherever the count has its last.
  std::optional<double> end_s = {};
  std::string named = "--seconds";  ///< what says `seconds`, as errors name it
};

/// A pose of the library for a key at each of these seconds, ascending: never the same twice in a
/// row, and none again before all were drawn; but where a passage returns that of the key which
/// stood there before. Equal arguments give equal poses. Indices below `poses`.
std::vector<size_t> DrawPoses(std::span<const double> times, std::span<const Passage> passages,
                              uint64_t seed, size_t poses);

/// The id of a dance's key, counted from 1 on.
std::string IdOfKey(size_t number, const LibraryPose& pose);

/// Key poses of the library on beats of the music: one to begin with, at second 0, then about one
/// each bar, as DrawPoses draws them, walking over the floor within two metres of the origin and
/// turning by and by. Where there are no beats, every two seconds. The same request gives the
/// same keys. Throws Error(kInvalidArgument, named) for a dance of less than two seconds.
std::vector<client::KeyPose> ComposeKeys(const CompositionRequest& request,
                                         std::span<const LibraryPose> poses);

}  // namespace choreo::cli
