#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

namespace choreo {

/// A player of a dance, as a server imagines its client: it plays the frames from the first one on,
/// and stops while it has none.
class Player {
 public:
  using Clock = std::chrono::steady_clock;

  /// `fps`: of the frames, above 0.
  explicit Player(double fps) : fps_(fps) {}

  /// Takes the frames from `first_frame` on, which were made and went out at these times. Returns
  /// how many seconds after the player needed them they went out. The time until they were made
  /// does not count: SampleQueue counts it.
  double Take(int64_t first_frame, Clock::time_point made, Clock::time_point sent) {
    const Seconds played(static_cast<double>(first_frame) / fps_);
    const Seconds begin = Seconds(made.time_since_epoch()) - played;
    begun_ = std::max(begun_.value_or(begin), begin);
    const Seconds late =
        std::max(Seconds(0), Seconds(sent.time_since_epoch()) - (*begun_ + played));
    *begun_ += late;
    return late.count();
  }

 private:
  using Seconds = std::chrono::duration<double>;

  const double fps_;
  std::optional<Seconds> begun_;  // on Clock, when it played frame 0
};

}  // namespace choreo
