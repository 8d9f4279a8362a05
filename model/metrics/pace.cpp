#include "model/metrics/pace.h"

#include <algorithm>
#include <cmath>

#include "model/motion/velocity.h"

namespace choreo {

void Pace::Add(const JointTrack& track, double fps) {
  for (size_t t = 1; t < track.size(); ++t) {
    for (Eigen::Index j = 0; j < track[t].cols(); ++j) {
      speeds.push_back(static_cast<float>((track[t].col(j) - track[t - 1].col(j)).norm() * fps));
      if (t < 3) continue;
      const auto at = [&](size_t back) { return track[t - back].col(j); };
      jerks.push_back(static_cast<float>(JointJerk(at(3), at(2), at(1), at(0), fps)));
    }
  }
}

void Pace::Add(const Pace& other) {
  speeds.insert(speeds.end(), other.speeds.begin(), other.speeds.end());
  jerks.insert(jerks.end(), other.jerks.begin(), other.jerks.end());
}

double Pace::median_speed() const { return Percentile(speeds, 0.5); }
double Pace::median_jerk() const { return Percentile(jerks, 0.5); }

double Percentile(std::vector<float> values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(
      std::max(1.0, std::ceil(share * static_cast<double>(values.size()) - 1e-9)));
  std::ranges::nth_element(values, values.begin() + rank - 1);
  return values[static_cast<size_t>(rank - 1)];
}

}  // namespace choreo
