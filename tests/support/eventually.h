#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace choreo {

/// Polls a condition that other threads or processes bring about. Returns false if it does not hold
/// within the limit.
inline bool Eventually(const std::function<bool()>& condition,
                       std::chrono::seconds limit = std::chrono::seconds(20)) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace choreo
