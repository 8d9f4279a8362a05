#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/authoring/keys/pose_library.h"
#include "client/choreo_client.h"
#include "model/core/passage.h"

namespace choreo::authoring {

/// A request for key poses of a dance of `seconds`.
struct CompositionRequest {
  double seconds = 0;
  std::vector<double> beats = {};      ///< seconds, ascending; may be empty
  size_t one = 0;                      ///< index of the beat that is count 1
  std::vector<Passage> passages = {};  ///< repeats in the music
  uint64_t seed = 0;
  /// The seed of the path over the floor, which dancers share to keep their formation.
  std::optional<uint64_t> way = {};
  /// Time of the last key, at most `seconds`; none: the last time that fits the bars.
  std::optional<double> end_s = {};
  std::string named = "seconds";  ///< the field of errors about `seconds`
};

/// Draws a library pose for a key at each of `times`, ascending seconds. Draws all poses before any
/// pose again, never one twice in a row, and no ending first. A repeated passage gets the poses of
/// the original. Deterministic. Returns indices of `poses`.
std::vector<size_t> DrawPoses(std::span<const double> times, std::span<const Passage> passages,
                              uint64_t seed, std::span<const LibraryPose> poses);

/// The id of a dance's key, counted from 1.
std::string IdOfKey(size_t number, const LibraryPose& pose);

/// Makes keys of library poses on the music's beats. The first is at second 0; the others are about
/// one per bar, on count 1 and on counts at equal distances from it, or every two seconds without
/// beats. DrawPoses draws the poses. The dancer walks within two metres of the origin and turns
/// gradually. Deterministic. Throws Error(kInvalidArgument, named) for a dance of less than two
/// seconds.
std::vector<client::KeyPose> ComposeKeys(const CompositionRequest& request,
                                         std::span<const LibraryPose> poses);

}  // namespace choreo::authoring
