#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace choreo {

/// Measures how many seconds after its original a repeated passage comes, to a hundredth: where
/// their onsets coincide. Not thread-safe.
class RepeatLag {
 public:
  /// `mono`: the whole song at 22 050 Hz.
  explicit RepeatLag(std::span<const float> mono);

  /// The lag nearest to `lag`, within kSearch_s, at which [from, to) is most like what precedes it
  /// by the lag. `lag` itself where nothing begins. Seconds.
  double Near(double lag, double from, double to) const;

  static constexpr double kSearch_s = 0.5;

 private:
  static constexpr int kBands = 12;
  Eigen::Matrix<float, kBands, Eigen::Dynamic> rises_;  // of each band's level, by hop
};

}  // namespace choreo
