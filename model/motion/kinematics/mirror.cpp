#include "model/motion/kinematics/mirror.h"

#include "model/core/error.h"

namespace choreo {

std::string OtherSide(const std::string& name) {
  if (name.starts_with("left_")) return std::string("right_").append(name, 5);
  if (name.starts_with("right_")) return std::string("left_").append(name, 6);
  return name;
}

std::vector<int> MirrorPairs(const Skeleton& skeleton) {
  std::vector<int> pairs;
  for (const std::string& name : skeleton.joint_names) {
    const std::string other = OtherSide(name);
    pairs.push_back(skeleton.Find(other));
    if (pairs.back() < 0) {
      throw InvalidArgument("skeleton.joint_names",
                            "'" + name + "' has no counterpart '" + other + "'");
    }
  }
  return pairs;
}

Pose Mirror(const std::vector<int>& pairs, const Pose& pose) {
  Pose mirrored;
  mirrored.root_position = {-pose.root_position.x(), pose.root_position.y(),
                            pose.root_position.z()};
  mirrored.rotations.resize(3, pose.rotations.cols());
  for (Eigen::Index joint = 0; joint < pose.rotations.cols(); ++joint) {
    // An axis is a pseudovector: the component across the mirror keeps its sign, the others flip.
    const Eigen::Vector3d w = pose.rotations.col(pairs[joint]);
    mirrored.rotations.col(joint) << w.x(), -w.y(), -w.z();
  }
  return mirrored;
}

Pose Mirror(const Skeleton& skeleton, const Pose& pose) {
  return Mirror(MirrorPairs(skeleton), pose);
}

Motion Mirror(const Skeleton& skeleton, const Motion& motion) {
  const std::vector<int> pairs = MirrorPairs(skeleton);
  Motion mirrored;
  mirrored.fps = motion.fps;
  mirrored.frames.reserve(motion.frames.size());
  for (const Pose& pose : motion.frames) mirrored.frames.push_back(Mirror(pairs, pose));
  return mirrored;
}

}  // namespace choreo
