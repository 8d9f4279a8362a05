#pragma once

#include <chrono>

namespace choreo {

/// The clock of StepJob::NextDeadline, seconds. It decides who goes first, never what is danced.
inline double PlaybackClock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace choreo
