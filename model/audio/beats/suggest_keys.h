#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "model/audio/beats/beats.h"
#include "model/core/passage.h"

namespace choreo {

/// The shortest time between key poses, seconds: about the duration of a change of pose.
inline constexpr double kMinKeyInterval = 1.2;
/// The earliest time of suggested keys, seconds. A dancer can't reach a pose earlier at ease.
inline constexpr double kFirstKey = 1;

/// What begins at a beat; each value includes the ones before it. An eight is two bars of four or
/// of three beats, counted from the first bar and again from passages and short bars.
enum class Phrase { kBeat, kBar, kEight, kPassage };

/// A beat that suits a key pose.
struct SuggestedKey {
  double time_s = 0;
  size_t beat = 0;      ///< index into the track's beats
  double strength = 0;  ///< onset strength relative to the strongest beat: 0 to 1
  Phrase begins = Phrase::kBeat;
};

/// The number of keys to suggest, and the part of a song.
struct SuggestionRequest {
  int64_t count = 0;
  double from_s = 0, until_s = std::numeric_limits<double>::infinity();
  std::string named = "count";  ///< the field of errors about `count`
};

/// The Phrase of each beat. A repeated passage begins at the nearest downbeat and is counted like
/// the original. All are kBeat if there are no bars.
std::vector<Phrase> FindPhrases(const BeatTrack& track, std::span<const Passage> passages);

/// The largest number of keys that fit, each on the first beat far enough from the key before.
int64_t MostKeys(std::span<const double> beats);

/// Chooses beats for key poses, ascending, from kFirstKey on, at least kMinKeyInterval apart.
/// Maximises the sum of strengths and phrases (1 for a bar, 2 for an eight, 3 for a passage), less
/// the squared relative deviation of each interval from an even distribution between the first and
/// the last beat. `onset_strength`: the envelope in which the beats were found. Deterministic.
/// Throws Error(kInvalidArgument), whose field is `named`, if the count is less than 1 or more than
/// fit between the beats.
std::vector<SuggestedKey> SuggestKeys(const BeatTrack& track, std::span<const float> onset_strength,
                                      std::span<const Passage> passages,
                                      const SuggestionRequest& request);

}  // namespace choreo
