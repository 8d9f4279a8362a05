#include "proto/wire/read_pose.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <utility>

#include "model/core/error.h"
#include "model/core/field.h"
#include "model/motion/rotation.h"
#include "proto/wire/convert.h"

namespace choreo::wire {
namespace {

constexpr double kUnitTolerance = 1e-3;

Eigen::Vector3d FromQuaternionNumbers(const float* v, const std::string& field) {
  const Eigen::Quaterniond q(v[3], v[0], v[1], v[2]);
  if (!(std::abs(q.norm() - 1) <= kUnitTolerance)) {
    throw InvalidArgument(field, "norm " + Show(q.norm()) + " of the quaternion is further than " +
                                     Show(kUnitTolerance) + " from 1");
  }
  return ExpFromQuaternion(q.normalized());
}

Eigen::Vector3d FromMatrixNumbers(const float* v, const std::string& field) {
  Eigen::Matrix3d r;
  for (int i = 0; i < 9; ++i) r(i / 3, i % 3) = v[i];
  const double error = (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= kUnitTolerance) || !(r.determinant() > 0)) {
    throw InvalidArgument(field, "not a rotation matrix: R^T R is " + Show(error) +
                                     " from the identity (limit " + Show(kUnitTolerance) +
                                     "), its determinant is " + Show(r.determinant()));
  }
  return LogMap(MatrixFromSixD(
      (Eigen::Matrix<double, 6, 1>() << r.col(0), r.col(1)).finished()));  // orthonormal again
}

Eigen::Vector3d ToVector(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

int NumbersPerJoint(v1::RotationEncoding encoding, const std::string& field) {
  switch (encoding) {
    case v1::ROTATION_ENCODING_UNSPECIFIED:
    case v1::ROTATION_ENCODING_AXIS_ANGLE:
      return 3;
    case v1::ROTATION_ENCODING_QUATERNION:
      return 4;
    case v1::ROTATION_ENCODING_MATRIX:
      return 9;
    default:
      throw InvalidArgument(field, std::to_string(encoding) + " is no RotationEncoding");
  }
}

Eigen::Matrix3Xd ToRotations(const v1::Pose& pose, const Skeleton& skeleton,
                             const std::string& field) {
  const int width = NumbersPerJoint(pose.encoding(), field + ".encoding");
  const std::string path = field + ".rotations";
  if (pose.rotations_size() != width * skeleton.joints()) {
    const bool whole = pose.rotations_size() % width == 0;
    throw InvalidArgument(path,
                          std::to_string(pose.rotations_size()) + " numbers are " +
                              (whole ? std::to_string(pose.rotations_size() / width) + " joints"
                                     : "no multiple of " + std::to_string(width)) +
                              "; the model has " + std::to_string(skeleton.joints()) + " joints, " +
                              std::to_string(width * skeleton.joints()) + " numbers");
  }
  Eigen::Matrix3Xd rotations(3, skeleton.joints());
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const float* numbers = pose.rotations().data() + static_cast<std::ptrdiff_t>(joint) * width;
    for (int i = 0; i < width; ++i) {
      if (!std::isfinite(numbers[i])) {
        throw InvalidArgument(At(path, joint), Show(numbers[i]) + " is not finite");
      }
    }
    rotations.col(joint) = width == 3   ? Eigen::Vector3d(numbers[0], numbers[1], numbers[2])
                           : width == 4 ? FromQuaternionNumbers(numbers, At(path, joint))
                                        : FromMatrixNumbers(numbers, At(path, joint));
  }
  return rotations;
}

Pose ToPose(const v1::Pose& pose, const Skeleton& skeleton, const std::string& field) {
  if (!pose.has_root_position()) throw InvalidArgument(field + ".root_position", "missing");
  return {.root_position = ToVector(pose.root_position()),
          .rotations = ToRotations(pose, skeleton, field)};
}

Target ToTarget(const v1::Pose& pose, const v1::JointMask* mask, const Skeleton& skeleton,
                const std::string& pose_field, const std::string& mask_field) {
  Target target;
  target.pose.rotations = ToRotations(pose, skeleton, pose_field);
  target.mask.root_position = pose.has_root_position();
  if (pose.has_root_position()) target.pose.root_position = ToVector(pose.root_position());
  if (mask != nullptr) {
    target.mask.joints.assign(static_cast<size_t>(skeleton.joints()), false);
    int previous = -1;
    for (int i = 0; i < mask->joints_size(); ++i) {
      const int joint = mask->joints(i);
      if (joint <= previous || joint >= skeleton.joints()) {
        throw InvalidArgument(At(mask_field + ".joints", i),
                              std::to_string(joint) + " is not in [" +
                                  std::to_string(previous + 1) + ", " +
                                  std::to_string(skeleton.joints() - 1) + "]");
      }
      target.mask.joints[static_cast<size_t>(joint)] = true;
      previous = joint;
    }
  }
  return target;
}

std::optional<HandPose> ToHands(v1::HandPose hands, const std::string& field) {
  if (!v1::HandPose_IsValid(hands)) {
    throw InvalidArgument(
        field, std::to_string(hands) + ", must be 0 to " + std::to_string(v1::HandPose_MAX));
  }
  return FromProto(hands);
}

Key ToKey(const v1::Keyframe& keyframe, const Skeleton& skeleton, const std::string& field) {
  if (!keyframe.has_pose()) throw InvalidArgument(field + ".pose", "missing");
  Target target = ToTarget(keyframe.pose(), keyframe.has_mask() ? &keyframe.mask() : nullptr,
                           skeleton, field, field + ".mask");
  Key key{.id = keyframe.id(), .pose = std::move(target.pose), .mask = std::move(target.mask)};
  if (keyframe.has_hit()) key.hit = keyframe.hit();
  key.hands = ToHands(keyframe.hands(), field + ".hands");
  return key;
}

KeyMoment ToMoment(const v1::Keyframe& keyframe, const std::string& field) {
  switch (keyframe.when_case()) {
    case v1::Keyframe::kFrame:
      return AtFrame{keyframe.frame()};
    case v1::Keyframe::kTime:
      return AtTime{keyframe.time()};
    case v1::Keyframe::kIntervalAfterPrevious:
      return AfterPrevious{keyframe.interval_after_previous()};
    case v1::Keyframe::WHEN_NOT_SET:
      break;
  }
  throw InvalidArgument(field, "none of frame, time, interval_after_previous is there");
}

}  // namespace choreo::wire
