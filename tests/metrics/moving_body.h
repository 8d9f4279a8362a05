#pragma once

#include <cmath>
#include <functional>

#include "model/metrics/joint_track.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/skeleton.h"

namespace choreo::testing_support {

/// The rest pose, all of it carried to `at`(seconds), 30 frames a second.
inline JointTrack Carried(int frames, const std::function<Eigen::Vector3d(double)>& at) {
  const Skeleton& body = Skeleton::Smpl24();
  const Eigen::Matrix3Xd rest = JointPositions(body, RestPose(body));
  JointTrack track;
  for (int t = 0; t < frames; ++t) track.push_back(rest.colwise() + at(t / 30.0));
  return track;
}

inline double Wave(double hz, double seconds) { return std::sin(2 * M_PI * hz * seconds); }

}  // namespace choreo::testing_support
