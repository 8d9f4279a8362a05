#pragma once

#include <Eigen/Core>
#include <string>

#include "model/fit/sources/position_clip.h"
#include "model/fit/sources/sources.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// tang2018's markers on a motion of SMPL's body.
inline PositionClip Tang2018Markers(const Motion& motion) {
  PositionClip clip;
  clip.fps = motion.fps;
  clip.joint_names = Tang2018JointNames();
  for (const Pose& pose : motion.frames) {
    const JointPlacement placement = ForwardKinematics(Skeleton::Smpl24(), pose);
    Eigen::Matrix3Xd positions(3, clip.joint_names.size());
    for (size_t i = 0; i < clip.joint_names.size(); ++i) {
      const std::string& name = clip.joint_names[i];
      const bool left = name.starts_with("left_");
      const double out = left ? 1 : -1;
      const std::string side = left ? "left_" : "right_";
      std::string joint = name;
      Eigen::Vector3d offset = Eigen::Vector3d::Zero();
      if (name.ends_with("temple")) {
        joint = "head";
        offset << 0.05 * out, 0.07, -0.01;
      } else if (name == "waist") {
        joint = "pelvis";
        offset << 0, 0.04, 0.03;
      } else if (name.ends_with("heel")) {
        joint = side + "ankle";
        offset << 0, -0.05, -0.06;
      } else if (name.ends_with("ankle")) {
        offset << 0.025 * out, 0, 0;
      } else if (name.ends_with("toes")) {
        joint = side + "foot";
      } else if (name.ends_with("thumb")) {
        joint = side + "hand";
      }
      const int index = Skeleton::Smpl24().Find(joint);
      positions.col(static_cast<Eigen::Index>(i)) =
          placement.positions.col(index) + placement.rotations[index] * offset;
    }
    clip.frames.push_back(positions);
  }
  return clip;
}

/// tang61's rows on a motion of SMPL's body.
inline PositionClip Tang61Markers(const Motion& motion) {
  const PositionClip markers = Tang2018Markers(motion);
  PositionClip clip;
  clip.fps = motion.fps;
  clip.joint_names = Tang61JointNames();
  for (const Eigen::Matrix3Xd& frame : markers.frames) {
    const auto place = [&](const std::string& name) -> Eigen::Vector3d {
      return frame.col(IndexOf(markers.joint_names, name));
    };
    Eigen::Matrix3Xd positions(3, clip.joint_names.size());
    for (size_t i = 0; i < clip.joint_names.size(); ++i) {
      const std::string& name = clip.joint_names[i];
      Eigen::Vector3d position;
      if (name == "neck") {
        position = (place("waist") + 2 * place("left_temple")) / 3;
      } else if (name.ends_with("_sole")) {
        const std::string side = name.substr(0, name.size() - 4);
        position = 0.5 * (place(side + "heel") + place(side + "toes"));
      } else {
        position = place(name);
      }
      positions.col(static_cast<Eigen::Index>(i)) = position;
    }
    clip.frames.push_back(positions);
  }
  return clip;
}

}  // namespace choreo
