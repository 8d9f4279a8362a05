#pragma once

#include <span>
#include <string>

namespace choreo::cli {

/// How much later something happens: in seconds, or in counts of the music, which are its beats.
struct Delay {
  double amount = 0;
  bool counts = false;

  /// The moment so much later than `seconds`. Counts go on at their pace before the first beat and
  /// behind the last. Throws Error(kInvalidArgument, field) for counts where there are not two
  /// beats, which ascend.
  double After(double seconds, std::span<const double> beats, const std::string& field) const;
};

/// "2.5" are seconds; "8c", "8 counts" are counts. Throws Error(kInvalidArgument, field) for
/// anything else, and for less than `least` or more than kMaxSeconds.
Delay ParseDelay(const std::string& text, const std::string& field, double least = 0);

}  // namespace choreo::cli
