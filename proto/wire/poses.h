#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "choreo/v1/choreography.pb.h"
#include "choreo/v1/motion.pb.h"
#include "model/core/hand_pose.h"
#include "model/messages/key.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Converts poses, keys and hands to the API's messages and back. Functions that read a client's
/// message throw Error(kInvalidArgument) with the field's path, which begins with `field`. Their
/// callers check the numbers' ranges. Pure functions, thread-safe.
namespace choreo::wire {

/// Numbers per joint in an encoding: 3, 4 or 9.
int NumbersPerJoint(v1::RotationEncoding encoding, const std::string& field);

/// Converts joint rotations from any encoding to axis-angle, [3, joints].
Eigen::Matrix3Xd ToRotations(const v1::Pose& pose, const Skeleton& skeleton,
                             const std::string& field);

/// A pose with a required root position.
Pose ToPose(const v1::Pose& pose, const Skeleton& skeleton, const std::string& field);

/// Reads a key's pose and its mask, which may be empty. `mask` null: all joints.
Target ToTarget(const v1::Pose& pose, const v1::JointMask* mask, const Skeleton& skeleton,
                const std::string& pose_field, const std::string& mask_field);

/// Reads a hand pose; none if unspecified.
std::optional<HandPose> ToHands(v1::HandPose hands, const std::string& field);

/// Converts a key, without its frame.
Key ToKey(const v1::Keyframe& keyframe, const Skeleton& skeleton, const std::string& field);

KeyMoment ToMoment(const v1::Keyframe& keyframe, const std::string& field);

v1::Pose ToProto(const Pose& pose);
/// Omits the root position if the mask does not include one.
v1::Pose ToProto(const Pose& pose, const PoseMask& mask);
v1::JointMask ToProto(const PoseMask& mask);
/// Converts frames, without the candidate.
v1::Frames ToProto(int64_t first_frame, std::span<const Pose> poses,
                   std::span<const Contacts> contacts,
                   v1::RotationEncoding encoding = v1::ROTATION_ENCODING_AXIS_ANGLE);

}  // namespace choreo::wire
