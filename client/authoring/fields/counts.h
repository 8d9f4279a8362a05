#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/core/limits.h"

/// Times as people write them: in seconds, or in counts of the music, which are its beats.
namespace choreo::authoring {

/// A song's beats; one of them is count 1.
struct Counts {
  std::vector<double> beats = {};  ///< seconds, ascending
  size_t one = 0;                  ///< index of count 1
  /// The advice in errors about counts in music with fewer than two beats.
  std::string advice =
      "counts need music that has beats; name a song (choreo analyze shows its beats), or say "
      "seconds";

  bool operator==(const Counts&) const = default;
};

/// Makes counts from beats. Count 1 is the first of `ones` (downbeats, or the 1 of each eight), as
/// on the studio's ruler; without any, the first beat.
Counts CountsFrom(std::vector<double> beats, std::span<const double> ones);

/// A moment or a duration, written "2.5" (seconds) or "8c" (counts).
struct WrittenTime {
  double amount = 0;
  bool counts = false;

  /// Reads a duration: returns the second that is this much later than `seconds`. Counts keep their
  /// pace before the first beat and after the last. Throws Error(kInvalidArgument, field) for
  /// counts in music with fewer than two beats.
  double After(double seconds, const Counts& counted, const std::string& field) const;

  /// Reads a moment: returns seconds unchanged, and converts a count to seconds. Throws as After
  /// does, and for a count before second 0.
  double In(const Counts& counted, const std::string& field) const;
};

/// Converts a second to a count, in music with at least two beats: the inverse of WrittenTime::In.
double CountAt(double seconds, const Counts& counted);

/// The frame for a key at `frame`. A key one frame after the first moves to it, because one frame
/// is too short for a transition.
inline int64_t FrameForKey(int64_t frame) {
  return frame > 0 && frame < kMinKeyDistance ? 0 : frame;
}

/// The exact second of a key that was rounded to `frame`: a whole, half, third or quarter count
/// that rounds to it (FrameForKey), the simplest first. Without such a count or two beats: frame /
/// fps. So later shifts by counts do not add to the rounding.
double SecondOf(int64_t frame, double fps, const Counts& counted);

/// Returns the second `times` as far from `begin` as `seconds` is: in counts if the music has at
/// least two beats, otherwise in seconds.
double Stretched(double seconds, double begin, double times, std::span<const double> beats);

/// Parses "2.5" as seconds, and "8c" or "8 counts" as counts. Throws Error(kInvalidArgument, field)
/// for anything else, and for less than `least` or more than kMaxSeconds.
WrittenTime ParseTime(const std::string& text, const std::string& field, double least = 0);

}  // namespace choreo::authoring
