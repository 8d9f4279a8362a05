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

/// Our poses, keys and hands <-> the API's. Those that read a client's throw
/// Error(kInvalidArgument) with the path of the field, beginning with `field`; their callers check
/// how large the numbers are. Pure functions, thread-safe.
namespace choreo::wire {

/// Numbers per joint in an encoding: 3, 4 or 9.
int NumbersPerJoint(v1::RotationEncoding encoding, const std::string& field);

/// Joint rotations in any encoding -> axis-angle, [3, joints].
Eigen::Matrix3Xd ToRotations(const v1::Pose& pose, const Skeleton& skeleton,
                             const std::string& field);

/// A pose with a required root position.
Pose ToPose(const v1::Pose& pose, const Skeleton& skeleton, const std::string& field);

/// A key pose and its mask, which may be empty. `mask` null: all joints.
Target ToTarget(const v1::Pose& pose, const v1::JointMask* mask, const Skeleton& skeleton,
                const std::string& pose_field, const std::string& mask_field);

/// None if unspecified.
std::optional<HandPose> ToHands(v1::HandPose hands, const std::string& field);

/// A key without its frame.
Key ToKey(const v1::Keyframe& keyframe, const Skeleton& skeleton, const std::string& field);

KeyMoment ToMoment(const v1::Keyframe& keyframe, const std::string& field);

v1::Pose ToProto(const Pose& pose);
/// Omits the root position if the mask does not include one.
v1::Pose ToProto(const Pose& pose, const PoseMask& mask);
v1::JointMask ToProto(const PoseMask& mask);
/// All but the candidate.
v1::Frames ToProto(int64_t first_frame, std::span<const Pose> poses,
                   std::span<const Contacts> contacts,
                   v1::RotationEncoding encoding = v1::ROTATION_ENCODING_AXIS_ANGLE);

}  // namespace choreo::wire
