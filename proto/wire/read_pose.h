#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "choreo/v1/choreography.pb.h"
#include "choreo/v1/motion.pb.h"
#include "model/core/hand_pose.h"
#include "model/messages/key.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// The API's poses, keys and hands -> ours, as server and studio get them. Throw
/// Error(kInvalidArgument) with the path of the field, beginning with `field`. The callers check
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

}  // namespace choreo::wire
