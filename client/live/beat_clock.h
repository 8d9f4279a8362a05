#pragma once

#include <deque>
#include <optional>

#include "client/choreo_client.h"

namespace choreo::live {

/// Where the next beats of a live dance will be, told from those that it was danced to.
class BeatClock {
 public:
  void Hear(const client::Beat& beat);

  /// Seconds from beat to beat; none before there were three without a gap, and where the last is
  /// long ago.
  std::optional<double> Period(double now) const;
  double confidence() const { return beats_.empty() ? 0 : beats_.back().confidence; }
  /// The first beat at `seconds` or behind; `seconds` itself where there is no period.
  double AtOrBehind(double seconds, double now) const;

 private:
  std::optional<double> Step() const;  // the median

  std::deque<client::Beat> beats_;  // the last few
};

}  // namespace choreo::live
