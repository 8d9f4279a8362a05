#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

namespace choreo {

/// A model of the client's playback: it plays the frames in order from the first, and stalls while
/// it has none. Not thread-safe.
class Player {
 public:
  using Clock = std::chrono::steady_clock;

  /// `fps`: the frame rate, above 0.
  explicit Player(double fps) : fps_(fps) {}

  /// Records that the frames from `first_frame` on were generated at `made` and sent at `sent`.
  /// Returns by how many seconds sending made them late for playback. Excludes the time until
  /// `made`, which SampleQueue measures.
  double Record(int64_t first_frame, Clock::time_point made, Clock::time_point sent) {
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
  std::optional<Seconds> begun_;  // the time on Clock at which frame 0 was played
};

}  // namespace choreo
