#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/audio/music/passages.h"
#include "model/audio/music/repeat_lag.h"

namespace choreo {

/// Detects whether live music repeats, and predicts how it then continues. Takes 2 ms of CPU per
/// second of music, even after ten minutes. Not thread-safe.
class PassageEar {
 public:
  /// How far ahead of the music passages are predicted, seconds: the length of a transition.
  static constexpr double kAheadSeconds = 4;

  /// Takes the next mono samples at 22 050 Hz. Returns a passage when a repeat begins or ends, and
  /// once a second while the music repeats: seconds from the first sample on. A passage without
  /// length ends the last one.
  std::optional<Passage> Hear(std::span<const float> mono);

 private:
  PassageListener listener_;
  RepeatLag lags_;
  std::vector<float> mono_;  // from the listener's next moment on
  std::optional<int64_t> sent_lag_;
  int64_t sent_at_ = 0;  // in moments
};

}  // namespace choreo
