#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/signal/fourier.h"

namespace choreo {

/// Measures the lag of a repeated passage behind its original to a hundredth of a second, by
/// aligning their onsets. Not thread-safe.
class RepeatLag {
 public:
  /// Takes the next mono samples at 22 050 Hz.
  void Hear(std::span<const float> mono);

  /// The lag within half a second of `lag` at which [from, to) is most similar to the music before
  /// it. `lag` itself without onsets. Seconds.
  double Near(double lag, double from, double to) const;

 private:
  static constexpr double kSearch_s = 0.5;
  static constexpr int kBands = 12, kWindow = 1024;
  using Bands = Eigen::Matrix<float, kBands, 1>;

  Bands LevelsOf(std::span<const float> window);

  std::vector<float> mono_;  // from the next window on
  FourierPower fourier_{kWindow};
  std::vector<double> windowed_ = std::vector<double>(kWindow);
  Bands before_;              // the levels of the last window
  std::vector<Bands> rises_;  // of each band's level, by hop
};

}  // namespace choreo
