#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "model/audio/beats.h"
#include "model/core/passage.h"

namespace choreo {

/// A change of pose needs about as long: key poses stand at least so many seconds apart.
inline constexpr double kShortestKeyInterval = 1.2;

/// What begins at a beat; each has what is before it, too. An eight is two bars of four or of
/// three, counted from the first bar, and anew where a passage begins or a bar is cut short.
enum class Phrase { kBeat, kBar, kEight, kPassage };

/// A beat on which a key pose would sit well.
struct SuggestedKey {
  double time_s = 0;
  size_t beat = 0;      ///< index into the track's beats
  double strength = 0;  ///< of the onset there, over that of the strongest beat: 0 to 1
  Phrase begins = Phrase::kBeat;
};

/// How many keys are suggested, and for which part of a song.
struct SuggestionRequest {
  int64_t count = 0;
  double from_s = 0, until_s = std::numeric_limits<double>::infinity();
  std::string named = "count";  ///< what says `count`, as errors name it
};

/// Of each beat what begins there. What returns begins at the downbeat that is nearest, and then is
/// counted as it was before. Without bars there are but beats.
std::vector<Phrase> FindPhrases(const BeatTrack& track, std::span<const Passage> passages);

/// Chooses beats for key poses, ascending: of all choices that keep kShortestKeyInterval the one
/// with the best sum of strengths and of what begins (1 for a bar, 2 for an eight, 3 for a
/// passage), less the squared relative deviation of each interval from an even spread between the
/// first beat and the last. `onset_strength` is the envelope in which the beats were found. Equal
/// arguments give equal keys. Throws Error(kInvalidArgument), whose field is `named`, for a count
/// that is less than 1 or more than fit between the beats.
std::vector<SuggestedKey> SuggestKeys(const BeatTrack& track, std::span<const float> onset_strength,
                                      std::span<const Passage> passages,
                                      const SuggestionRequest& request);

}  // namespace choreo
