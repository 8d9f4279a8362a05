#pragma once

#include <chrono>

namespace choreo {

/// Tells the time to code that limits how long it waits, so that tests need not wait. Thread-safe.
class TimeSource {
 public:
  virtual ~TimeSource() = default;
  virtual std::chrono::steady_clock::time_point Now() const {
    return std::chrono::steady_clock::now();
  }
  /// The system's clock.
  static const TimeSource& System() {
    static const TimeSource system;
    return system;
  }
};

}  // namespace choreo
