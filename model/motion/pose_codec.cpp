#include "model/motion/pose_codec.h"

#include <string>

#include "model/core/error.h"
#include "model/motion/rotation.h"
#include "model/motion/velocity.h"

namespace choreo {
namespace {

void CheckWidth(Eigen::Index size, int width) {
  if (size != width) {
    throw InvalidArgument("x", "a pose vector of " + std::to_string(size) + " values, must be " +
                                   std::to_string(width));
  }
}

}  // namespace

void PoseCodec::CheckJoints(const Pose& pose, const char* field) const {
  if (pose.rotations.cols() != joints_) {
    throw InvalidArgument(field, std::to_string(pose.rotations.cols()) + " joints, must be " +
                                     std::to_string(joints_));
  }
}

void PoseCodec::Encode(const Pose& pose, const Pose& previous, const Pose* reference,
                       const Contacts& contacts, double fps,
                       Eigen::Ref<Eigen::VectorXf> out) const {
  CheckWidth(out.size(), width());
  CheckJoints(pose, "pose.rotations");
  CheckJoints(previous, "previous.rotations");
  Eigen::Vector3d position = pose.root_position;
  if (reference != nullptr) {
    CheckJoints(*reference, "reference.rotations");
    position -= reference->root_position;
  }
  out.segment<3>(position_at()) = position.cast<float>();
  for (int joint = 0; joint < joints_; ++joint) {
    const Eigen::Vector3d rotation =
        reference != nullptr
            ? RotationDifference(reference->rotations.col(joint), pose.rotations.col(joint))
            : NearestBranch(pose.rotations.col(joint), previous.rotations.col(joint));
    out.segment<3>(rotations_at() + 3 * joint) = rotation.cast<float>();
  }
  const RootVelocity velocity = RootVelocityBetween(previous, pose, fps);
  out.segment<3>(velocity_at()) =
      Eigen::Vector3d(velocity.forward, velocity.sideways, velocity.yaw).cast<float>();
  out.segment<4>(contacts_at()) = Eigen::Map<const Eigen::Vector4f>(contacts.data());
}

Eigen::VectorXf PoseCodec::Encode(const Pose& pose, const Pose& previous, const Pose* reference,
                                  const Contacts& contacts, double fps) const {
  Eigen::VectorXf x(width());
  Encode(pose, previous, reference, contacts, fps, x);
  return x;
}

void PoseCodec::Decode(Eigen::Ref<const Eigen::VectorXf> x, const Pose* reference,
                       Decoded& out) const {
  CheckWidth(x.size(), width());
  if (reference != nullptr) CheckJoints(*reference, "reference.rotations");
  out.pose.root_position = x.segment<3>(position_at()).cast<double>();
  if (reference != nullptr) out.pose.root_position += reference->root_position;
  out.pose.rotations.resize(3, joints_);
  for (int joint = 0; joint < joints_; ++joint) {
    const Eigen::Vector3d rotation = x.segment<3>(rotations_at() + 3 * joint).cast<double>();
    out.pose.rotations.col(joint) = reference != nullptr
                                        ? RotationCompose(reference->rotations.col(joint), rotation)
                                        : rotation;
  }
  Eigen::Map<Eigen::Vector4f>(out.contacts.data()) = x.segment<4>(contacts_at());
}

PoseCodec::Decoded PoseCodec::Decode(Eigen::Ref<const Eigen::VectorXf> x,
                                     const Pose* reference) const {
  Decoded decoded;
  Decode(x, reference, decoded);
  return decoded;
}

}  // namespace choreo
