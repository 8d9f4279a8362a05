#include "proto/wire/poses.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <utility>

#include "model/core/error.h"
#include "model/core/text/field.h"
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
      throw InvalidArgument(field, std::to_string(encoding) + " is not a RotationEncoding");
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
      const auto refuse = [&](const std::string& why) {
        throw InvalidArgument(At(mask_field + ".joints", i), std::to_string(joint) + why);
      };
      if (joint < 0 || joint >= skeleton.joints())
        refuse(" is not in [0, " + std::to_string(skeleton.joints() - 1) + "]");
      if (joint <= previous) {
        refuse(" is not after the joint before it, " + std::to_string(previous) +
               ": they are strictly increasing");
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
                           skeleton, field + ".pose", field + ".mask");
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

v1::Pose ToProto(const Pose& pose) {
  v1::Pose out;
  out.mutable_root_position()->set_x(pose.root_position.x());
  out.mutable_root_position()->set_y(pose.root_position.y());
  out.mutable_root_position()->set_z(pose.root_position.z());
  out.mutable_rotations()->Reserve(static_cast<int>(pose.rotations.size()));
  for (const double value : pose.rotations.reshaped()) out.add_rotations(static_cast<float>(value));
  out.set_encoding(v1::ROTATION_ENCODING_AXIS_ANGLE);
  return out;
}

v1::Pose ToProto(const Pose& pose, const PoseMask& mask) {
  v1::Pose out = ToProto(pose);
  if (!mask.root_position) out.clear_root_position();
  return out;
}

v1::JointMask ToProto(const PoseMask& mask) {
  v1::JointMask out;
  for (size_t joint = 0; joint < mask.joints.size(); ++joint) {
    if (mask.joints[joint]) out.add_joints(static_cast<int>(joint));
  }
  return out;
}

v1::Frames ToProto(int64_t first_frame, std::span<const Pose> poses,
                   std::span<const Contacts> contacts, v1::RotationEncoding encoding) {
  v1::Frames out;
  out.set_first_frame(first_frame);
  out.set_count(static_cast<int32_t>(poses.size()));
  const auto add = [&out](double value) { out.add_rotations(static_cast<float>(value)); };
  for (const Pose& pose : poses) {
    for (const double value : pose.root_position) out.add_root_positions(static_cast<float>(value));
    for (Eigen::Index joint = 0; joint < pose.rotations.cols(); ++joint) {
      const Eigen::Vector3d w = pose.rotations.col(joint);
      if (encoding == v1::ROTATION_ENCODING_QUATERNION) {
        for (const double value : QuaternionFromExp(w).coeffs()) add(value);
      } else if (encoding == v1::ROTATION_ENCODING_MATRIX) {
        const Eigen::Matrix3d r = ExpMap(w);
        for (int i = 0; i < 9; ++i) add(r(i / 3, i % 3));
      } else {
        for (const double value : w) add(value);
      }
    }
  }
  for (const Contacts& frame : contacts) out.mutable_contacts()->Add(frame.begin(), frame.end());
  return out;
}

}  // namespace choreo::wire
