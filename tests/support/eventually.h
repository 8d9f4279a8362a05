#pragma once

#include <chrono>
#include <cstdint>
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

/// Whether a count is above 0 and, for a while, stays as it is.
inline bool Settles(const std::function<int64_t()>& count) {
  int64_t before = 0;
  int same = 0;
  return Eventually([&] {
    const int64_t now = count();
    same = now == before && now > 0 ? same + 1 : 0;
    before = now;
    return same == 50;
  });
}

}  // namespace choreo
