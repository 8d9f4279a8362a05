#include "model/metrics/joint_track.h"

#include "model/motion/kinematics.h"

namespace choreo {

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

}  // namespace choreo
