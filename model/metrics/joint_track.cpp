#include "model/metrics/joint_track.h"

#include <string>

#include "model/core/error.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/velocity.h"

namespace choreo {

void CheckSameFrames(Eigen::Index danced, Eigen::Index other) {
  if (danced != other || danced == 0) {
    throw InvalidArgument("danced",
                          std::to_string(danced) + " frames against " + std::to_string(other));
  }
}

JointTrack TrackJoints(const Skeleton& skeleton, std::span<const Pose> poses) {
  JointTrack track;
  track.reserve(poses.size());
  for (const Pose& pose : poses) track.push_back(JointPositions(skeleton, pose));
  return track;
}

std::vector<float> MeanSpeeds(const JointTrack& track, double fps) {
  std::vector<float> speeds;
  for (size_t i = 1; i < track.size(); ++i) {
    speeds.push_back(static_cast<float>((track[i] - track[i - 1]).colwise().norm().mean() * fps));
  }
  return speeds;
}

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

}  // namespace choreo
