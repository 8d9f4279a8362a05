#include "model/motion/pose/pose_limits.h"

#include <cmath>
#include <sstream>

#include "model/core/error.h"
#include "model/core/text/field.h"

namespace choreo {
namespace {

template <typename... Parts>
std::string Text(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

}  // namespace

void CheckPoseLimits(const Pose& pose, double max_rotation, const std::string& limit_name,
                     const std::string& field) {
  for (int axis = 0; axis < 3; ++axis) {
    const double value = pose.root_position[axis];
    const auto at = [&] { return Text(field, ".root_position[", axis, "]"); };
    if (!std::isfinite(value)) throw InvalidArgument(at(), Text(value, " is not finite"));
    if (std::abs(value) > kMaxPosition) {
      throw InvalidArgument(at(),
                            Text(value, " m is further than ", kMaxPosition, " m from the origin"));
    }
  }
  for (Eigen::Index joint = 0; joint < pose.rotations.cols(); ++joint) {
    const double angle = pose.rotations.col(joint).norm();
    const auto at = [&] { return Text(field, ".rotations[", joint, "]"); };
    if (!std::isfinite(angle)) throw InvalidArgument(at(), Text(angle, " is not finite"));
    if (angle > max_rotation) {
      throw InvalidArgument(at(), Text(angle, " rad exceeds ", limit_name));
    }
  }
}

void CheckJoints(const Skeleton& skeleton, const Pose& pose, const std::string& field) {
  if (pose.rotations.cols() == skeleton.joints()) return;
  throw InvalidArgument(field + ".rotations", std::to_string(pose.rotations.cols()) +
                                                  " joints, the model has " +
                                                  std::to_string(skeleton.joints()));
}

void CheckKeyPose(const Skeleton& skeleton, const Pose& pose, const std::string& field) {
  CheckJoints(skeleton, pose, field);
  CheckPoseLimits(pose, kMaxRotation, "2π", field);
}

void CheckHistory(const Skeleton& skeleton, std::span<const Pose> poses, const std::string& field) {
  for (size_t i = 0; i < poses.size(); ++i) {
    const std::string pose = At(field, static_cast<int64_t>(i));
    CheckJoints(skeleton, poses[i], pose);
    CheckPoseLimits(poses[i], kMaxWoundRotation, Show(kMaxWoundRotation), pose);
  }
}

void CheckMotionLimits(const Motion& motion) {
  const std::string limit = Text(kMaxWoundRotation);
  for (size_t i = 0; i < motion.frames.size(); ++i)
    CheckPoseLimits(motion.frames[i], kMaxWoundRotation, limit, Text("frames[", i, "]"));
}

}  // namespace choreo
