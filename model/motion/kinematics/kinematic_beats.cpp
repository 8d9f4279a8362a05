#include "model/motion/kinematics/kinematic_beats.h"

#include <algorithm>
#include <cmath>

#include "model/core/numbers/gaussian_mean.h"

namespace choreo {
namespace {

constexpr double kBeatDeviation = 1.0 / 12;  // seconds

}  // namespace

std::vector<double> SmoothSpeeds(std::span<const float> speed, double fps) {
  const double deviation = kBeatDeviation * fps;
  const auto reach = static_cast<int64_t>(std::ceil(4 * deviation));
  const auto last = static_cast<int64_t>(speed.size()) - 1;
  std::vector<double> smooth(speed.size());
  for (int64_t i = 0; i <= last; ++i) {
    smooth[static_cast<size_t>(i)] =
        GaussianMean(std::max<int64_t>(0, i - reach), std::min(last, i + reach), i, deviation, 0.0,
                     [&](int64_t k) { return speed[static_cast<size_t>(k)]; });
  }
  return smooth;
}

std::vector<int64_t> KinematicBeats(std::span<const float> curve, double fps) {
  const std::vector<double> speed = SmoothSpeeds(curve, fps);
  std::vector<int64_t> beats;
  size_t start = 0;  // of the plateau that contains i
  for (size_t i = 1; i < speed.size(); ++i) {
    if (speed[i] == speed[i - 1]) continue;
    const bool rose = start > 0 && speed[start - 1] < speed[start];
    if (rose && speed[i] < speed[start]) beats.push_back(static_cast<int64_t>(start) + 1);
    start = i;
  }
  return beats;
}

}  // namespace choreo
