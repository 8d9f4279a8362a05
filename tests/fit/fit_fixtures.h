#pragma once

#include "model/fit/bones/character_body.h"
#include "model/fit/sources/position_clip.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/motion/motion_fixtures.h"

namespace choreo::fixtures {

/// Joint positions of a motion.
inline PositionClip Positions(const Skeleton& skeleton, const Motion& motion) {
  PositionClip clip;
  clip.fps = motion.fps;
  clip.joint_names = skeleton.joint_names;
  for (const Pose& pose : motion.frames) clip.frames.push_back(JointPositions(skeleton, pose));
  return clip;
}

/// A dance within a body's joint limits, so that sources of other proportions can follow.
inline Motion Dance(int frames) {
  Motion motion = SmoothMotion(Skeleton::Smpl24(), 21, frames);
  for (Pose& pose : motion.frames) {
    for (int joint = 1; joint < Skeleton::Smpl24().joints(); ++joint) {
      const std::string& name = Skeleton::Smpl24().joint_names[joint];
      const bool hinge = name.ends_with("knee") || name.ends_with("elbow");
      const bool limb = name.ends_with("hip") || name.ends_with("shoulder");
      if (!hinge) pose.rotations.col(joint) *= limb ? 0.8 : 0.25;
    }
  }
  return motion;
}

/// A rig by SMPL's names that stands in this pose at rest.
inline CharacterBody Rigged(const Skeleton& body, const Pose& rest) {
  return MakeCharacterBody(FindHumanBones(body.joint_names), JointPositions(body, rest));
}

}  // namespace choreo::fixtures
