#pragma once

#include <deque>
#include <optional>

#include "client/choreo_client.h"

namespace choreo::live {

/// Predicts the next beats of a live dance from its past ones.
class BeatClock {
 public:
  void Hear(const client::Beat& beat);

  /// Seconds between beats. None until there are three beats without a gap, and if the last beat
  /// was long before `now`.
  std::optional<double> Period(double now) const;
  double confidence() const { return beats_.empty() ? 0 : beats_.back().confidence; }
  /// The second of the first beat at or after `seconds`; `seconds` itself if there is no period.
  double AtOrAfter(double seconds, double now) const;

 private:
  std::optional<double> Step() const;  // the median

  std::deque<client::Beat> beats_;  // the last few
};

}  // namespace choreo::live
