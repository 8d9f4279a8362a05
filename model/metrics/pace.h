#pragma once

#include <vector>

#include "model/core/quantile.h"
#include "model/metrics/joint_track.h"

namespace choreo {

/// How fast and how jerky a dance is, over all its joints and frames. Jerk, the third derivative of
/// position, is the measure of smooth movement since Flash and Hogan (1985); of motion models it is
/// reported by Yi et al. 2021 (TransPose), for one. Medians, since both have long tails.
struct Pace {
  std::vector<float> speeds;  ///< m/s, of each joint and step
  std::vector<float> jerks;   ///< m/s^3, third difference of each joint and four frames

  void Add(const JointTrack& track, double fps);
  void Add(const Pace& other);
  double median_speed() const;
  double median_jerk() const;
};

}  // namespace choreo
