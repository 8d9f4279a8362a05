#include "model/formats/bvh.h"

#include "model/formats/bvh_placement.h"
#include "model/motion/resample.h"

namespace choreo {

double BvhFile::fps() const { return WholeRate(1 / frame_time); }

std::vector<std::string> BvhFile::JointNames() const {
  std::vector<std::string> names;
  for (const BvhJoint& joint : joints) names.push_back(joint.name);
  return names;
}

Eigen::Matrix3Xd BvhPositions(const BvhFile& file, int64_t frame) {
  Eigen::Matrix3Xd positions(3, file.joints.size());
  std::vector<Eigen::Matrix3d> rotations(file.joints.size());
  const double* values = file.values.col(frame).data();
  for (size_t i = 0; i < file.joints.size(); ++i) {
    const BvhJoint& joint = file.joints[i];
    const BvhPlacement local = PlaceBvhJoint(joint, values);
    values += joint.channels.size();
    if (joint.parent < 0) {
      positions.col(i) = local.position;
      rotations[i] = local.rotation;
    } else {
      positions.col(i) = positions.col(joint.parent) + rotations[joint.parent] * local.position;
      rotations[i] = rotations[joint.parent] * local.rotation;
    }
  }
  return positions;
}

PositionClip BvhToPositions(const BvhFile& file, double metres_per_unit) {
  PositionClip clip;
  clip.fps = file.fps();
  clip.joint_names = file.JointNames();
  for (int64_t frame = 0; frame < file.frames(); ++frame) {
    clip.frames.push_back(BvhPositions(file, frame) * metres_per_unit);
  }
  return clip;
}

}  // namespace choreo
