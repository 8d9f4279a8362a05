#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace choreo {

/// Counts values by bucket, as Prometheus does. Lock-free and thread-safe.
class Histogram {
 public:
  struct Snapshot {
    std::vector<double> bounds;  ///< ascending; a value equal to a bound counts below it
    std::vector<uint64_t>
        counts;      ///< by bucket, one more than bounds; the last counts values above all bounds
    double sum = 0;  ///< of all values

    /// Adds the counts of a snapshot with the same bounds.
    Snapshot& operator+=(const Snapshot& other) {
      for (size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
      sum += other.sum;
      return *this;
    }
  };

  explicit Histogram(std::vector<double> bounds)
      : bounds_(std::move(bounds)), counts_(bounds_.size() + 1) {}

  /// Counts a value in the lowest bucket whose bound is not below it.
  void Add(double value) noexcept {
    const auto at = std::ranges::lower_bound(bounds_, value) - bounds_.begin();
    counts_[static_cast<size_t>(at)].fetch_add(1, std::memory_order_relaxed);
    sum_.fetch_add(value, std::memory_order_relaxed);
  }

  Snapshot snapshot() const {
    Snapshot now{.bounds = bounds_, .counts = {}, .sum = sum_.load(std::memory_order_relaxed)};
    for (const auto& count : counts_) now.counts.push_back(count.load(std::memory_order_relaxed));
    return now;
  }

  /// Bounds for durations in seconds: 0.1 ms to 5 s.
  static std::vector<double> Seconds() {
    constexpr double kFrame = 0.033;  // a frame at 30 fps
    return {1e-4,   2.5e-4, 5e-4, 1e-3, 2.5e-3, 5e-3, 0.01, 0.025,
            kFrame, 0.05,   0.1,  0.25, 0.5,    1,    2.5,  5};
  }

  /// 1 ms to an hour, the longest dance.
  static std::vector<double> CallSeconds() {
    return {1e-3, 0.01, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 30, 60, 120, 300, 600, 1800, 3600};
  }

 private:
  const std::vector<double> bounds_;
  std::vector<std::atomic<uint64_t>> counts_;
  std::atomic<double> sum_ = 0;
};

}  // namespace choreo
