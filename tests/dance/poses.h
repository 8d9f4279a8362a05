#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A pose within what people do: up to `bend` radians in every joint, turned anywhere, up to
/// `reach` metres from the origin.
inline Pose RandomPose(std::mt19937& random, double bend = 0.8, double reach = 1.0) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const Skeleton& skeleton = Skeleton::Smpl24();
  Pose pose = RestPose(skeleton);
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const Eigen::Vector3d axis = Eigen::Vector3d(unit(random), unit(random), unit(random));
    pose.rotations.col(joint) = axis.normalized() * bend * unit(random);
  }
  const Eigen::Matrix3d turn = HeadingRotation(3.1 * unit(random));
  pose.rotations.col(0) = LogMap(turn * ExpMap(pose.rotations.col(0)));
  pose.root_position += reach * Eigen::Vector3d(unit(random), 0.1 * unit(random), unit(random));
  return pose;
}

/// A short motion up to `last`: the poses before it lie on a smooth way to it.
inline std::vector<Pose> MotionTo(const Pose& last, int frames, std::mt19937& random,
                                  double speed = 0.01) {
  std::normal_distribution<double> normal;
  std::vector<Pose> poses(static_cast<size_t>(frames), last);
  const Eigen::Vector3d drift =
      speed * Eigen::Vector3d(normal(random), 0.2 * normal(random), normal(random));
  Eigen::Matrix3Xd turning(3, last.rotations.cols());
  for (double& value : turning.reshaped()) value = speed * normal(random);
  for (int i = frames - 2; i >= 0; --i) {
    const Pose& next = poses[static_cast<size_t>(i) + 1];
    Pose& pose = poses[static_cast<size_t>(i)];
    pose.root_position = next.root_position - drift;
    for (int joint = 0; joint < pose.rotations.cols(); ++joint) {
      pose.rotations.col(joint) = RotationCompose(next.rotations.col(joint), -turning.col(joint));
    }
  }
  return poses;
}

inline bool SameBits(const Pose& a, const Pose& b) {
  return a.root_position == b.root_position && a.rotations == b.rotations;
}

/// Moves and turns a pose about the vertical.
inline Pose Placed(const Pose& pose, double heading, const Eigen::Vector3d& shift) {
  const Eigen::Matrix3d turn = HeadingRotation(heading);
  Pose placed = pose;
  placed.root_position = turn * pose.root_position + shift;
  placed.rotations.col(0) = LogMap(turn * ExpMap(pose.rotations.col(0)));
  return placed;
}

}  // namespace choreo
