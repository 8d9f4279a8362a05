#pragma once

#include <span>
#include <string>

namespace choreo::authoring {

/// A delay in seconds, or in counts of the music, which are its beats.
struct Delay {
  double amount = 0;
  bool counts = false;

  /// The time this much later than `seconds`. Counts continue at their pace before the first beat
  /// and after the last. Throws Error(kInvalidArgument, field) for counts without two ascending
  /// beats.
  double After(double seconds, std::span<const double> beats, const std::string& field) const;
};

/// `seconds`, `times` as far from `begin`: in counts where the music has two beats or more, else in
/// seconds.
double Stretched(double seconds, double begin, double times, std::span<const double> beats);

/// Parses "2.5" as seconds; "8c", "8 counts" as counts. Throws Error(kInvalidArgument, field) for
/// anything else, and for less than `least` or more than kMaxSeconds.
Delay ParseDelay(const std::string& text, const std::string& field, double least = 0);

}  // namespace choreo::authoring
