#pragma once

#include <string>
#include <vector>

#include "model/fit/sources/tang2018_skeleton.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/tang2018_markers.h"

namespace choreo::testing_support {

/// tang2018's own skeleton, measured on a synthetic dance of ours.
inline const NativeTang2018& Native() {
  static const NativeTang2018 native = [] {
    const PositionClip clip = Tang2018Markers(fixtures::SmoothMotion(Skeleton::Smpl24(), 1, 60));
    return MeasureTang2018(std::span(&clip, 1));
  }();
  return native;
}

/// The recording of a dance on that skeleton, metres.
inline PositionClip RecordNative(const Motion& motion) {
  const auto& [skeleton, mapping] = Native();
  PositionClip clip{.fps = motion.fps, .joint_names = Tang2018JointNames(), .frames = {}};
  for (const Pose& pose : motion.frames) {
    const JointPlacement placement = ForwardKinematics(skeleton, pose);
    Eigen::Matrix3Xd points(3, std::ssize(clip.joint_names));
    for (const Landmark& landmark : mapping.landmarks) {
      if (landmark.source.size() != 1) continue;  // not recorded; between recorded points
      const OurPoint& point = landmark.ours.front();
      const int joint = skeleton.Find(point.joint);
      points.col(IndexOf(clip.joint_names, landmark.source.front().first)) =
          placement.positions.col(joint) +
          placement.rotations[static_cast<size_t>(joint)] * point.offset;
    }
    clip.frames.push_back(points);
  }
  return clip;
}

}  // namespace choreo::testing_support
