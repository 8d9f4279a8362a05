#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

/// Times as people write them: in seconds, or in counts of the music, which are its beats.
namespace choreo::authoring {

/// A song's beats; one of them is count 1.
struct Counts {
  std::vector<double> beats = {};  ///< seconds, ascending
  size_t one = 0;                  ///< index of count 1
  /// The advice of errors about counts without two beats.
  std::string advice =
      "counts need music that has beats; name a song (choreo analyze shows its beats), or say "
      "seconds";

  bool operator==(const Counts&) const = default;
};

/// Counts from the first of these beats (downbeats, or the 1 of each eight) like the studio's
/// ruler; if there are none, from the first beat.
Counts CountsFrom(std::vector<double> beats, std::span<const double> ones);

/// "2.5" or "8c": a moment, or a duration.
struct WrittenTime {
  double amount = 0;
  bool counts = false;

  /// Reads a duration: returns the time this much later than `seconds`. Counts continue at their
  /// pace before the first beat and after the last. Throws Error(kInvalidArgument, field) for
  /// counts without two beats.
  double After(double seconds, const Counts& counted, const std::string& field) const;

  /// Reads a moment: returns seconds unchanged, and for counts the second of that count. Fails as
  /// After does, and for a count before second 0.
  double In(const Counts& counted, const std::string& field) const;
};

/// The count at a second, of music with two beats or more: the inverse of WrittenTime::In.
double CountAt(double seconds, const Counts& counted);

/// Moves `seconds` to `times` its distance from `begin`: in counts if the music has two beats or
/// more, else in seconds.
double Stretched(double seconds, double begin, double times, std::span<const double> beats);

/// Parses "2.5" as seconds; "8c", "8 counts" as counts. Throws Error(kInvalidArgument, field) for
/// anything else, and for less than `least` or more than kMaxSeconds.
WrittenTime ParseTime(const std::string& text, const std::string& field, double least = 0);

}  // namespace choreo::authoring
