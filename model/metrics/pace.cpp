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

}  // namespace choreo
