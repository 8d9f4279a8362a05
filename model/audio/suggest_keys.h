#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/audio/beats.h"

namespace choreo {

/// A change of pose needs about as long: key poses stand at least so many seconds apart.
inline constexpr double kShortestKeyInterval = 1.2;

/// A beat on which a key pose would sit well.
struct SuggestedKey {
  double time_s = 0;
  size_t beat = 0;      ///< index into the track's beats
  double strength = 0;  ///< of the onset there, over that of the song's strongest beat: 0 to 1
};

/// Chooses `count` beats for key poses, ascending: of all choices that keep kShortestKeyInterval
/// the one with the best sum of strengths, less the squared relative deviation of each interval
/// from an even spread between the first beat and the last. `onset_strength` is the envelope in
/// which the beats were found. Equal arguments give equal keys. Throws Error(kInvalidArgument),
/// whose field is `name`, for a count that is less than 1 or more than fit between the beats.
std::vector<SuggestedKey> SuggestKeys(const BeatTrack& track, std::span<const float> onset_strength,
                                      int64_t count, const std::string& name);

}  // namespace choreo
