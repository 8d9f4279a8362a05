#pragma once

#include <atomic>
#include <chrono>

#include "server/process/time_source.h"

namespace choreo {

/// The system's clock, ahead by what a test lets pass. Thread-safe.
class AdvancedClock final : public TimeSource {
 public:
  std::chrono::steady_clock::time_point Now() const override {
    return TimeSource::Now() + ahead_.load();
  }
  void Advance(std::chrono::milliseconds time) { ahead_ = ahead_.load() + time; }

 private:
  std::atomic<std::chrono::milliseconds> ahead_{};
};

}  // namespace choreo
