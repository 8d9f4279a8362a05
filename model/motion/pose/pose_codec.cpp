#include "model/motion/pose/pose_codec.h"

#include <string>

#include "model/core/error.h"
#include "model/motion/kinematics/velocity.h"
#include "model/motion/rotation.h"

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

void PoseCodec::Encode(const Pose& pose, const Pose& previous, const Contacts& contacts, double fps,
                       Eigen::Ref<Eigen::VectorXf> out) const {
  CheckWidth(out.size(), width());
  CheckJoints(pose, "pose.rotations");
  CheckJoints(previous, "previous.rotations");
  out.segment<3>(position_at()) = pose.root_position.cast<float>();
  for (int joint = 0; joint < joints_; ++joint) {
    out.segment<3>(rotations_at() + 3 * joint) =
        NearestBranch(pose.rotations.col(joint), previous.rotations.col(joint)).cast<float>();
  }
  const RootVelocity velocity = RootVelocityBetween(previous, pose, fps);
  out.segment<3>(velocity_at()) =
      Eigen::Vector3d(velocity.forward, velocity.sideways, velocity.yaw).cast<float>();
  out.segment<4>(contacts_at()) = Eigen::Map<const Eigen::Vector4f>(contacts.data());
}

Eigen::VectorXf PoseCodec::Encode(const Pose& pose, const Pose& previous, const Contacts& contacts,
                                  double fps) const {
  Eigen::VectorXf x(width());
  Encode(pose, previous, contacts, fps, x);
  return x;
}

void PoseCodec::Decode(Eigen::Ref<const Eigen::VectorXf> x, Decoded& out) const {
  CheckWidth(x.size(), width());
  out.pose.root_position = x.segment<3>(position_at()).cast<double>();
  out.pose.rotations = x.segment(rotations_at(), 3 * joints_).cast<double>().reshaped(3, joints_);
  Eigen::Map<Eigen::Vector4f>(out.contacts.data()) = x.segment<4>(contacts_at());
}

PoseCodec::Decoded PoseCodec::Decode(Eigen::Ref<const Eigen::VectorXf> x) const {
  Decoded decoded;
  Decode(x, decoded);
  return decoded;
}

}  // namespace choreo
