#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/audio/passages.h"

namespace choreo::live {

/// Hears in music that sounds now whether it comes back, and how it goes on then.
class PassageEar {
 public:
  /// What is told reaches so far ahead of the music, seconds: as transitions do.
  static constexpr double kAheadSeconds = 4;

  /// The next mono samples, at 22 050 Hz. What there is to tell, once a second while the music
  /// comes back, and where it begins or ends to.
  std::optional<Passage> Hear(std::span<const float> mono);

 private:
  PassageListener listener_;
  std::vector<float> mono_;  // from the listener's next moment on
  std::optional<int64_t> told_lag_;
  int64_t told_at_ = 0;  // moments
};

}  // namespace choreo::live
