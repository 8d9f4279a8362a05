#pragma once

#include <span>
#include <string>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Limits of poses from clients and files.
namespace choreo {

inline constexpr double kMaxPosition = 10'000;  ///< metres from the origin along each axis
/// The largest rotation angle of a key, radians: 2π, rounded up for senders that compute in floats.
inline constexpr double kMaxRotation = 6.2832;
/// The largest rotation angle of a motion, radians. Continuous branches may wind up this far;
/// beyond it a float has too little precision.
inline constexpr double kMaxWoundRotation = 1'000;

/// Throws Error(kInvalidArgument) unless all numbers are finite, the position within kMaxPosition
/// and every angle at most `max_rotation`, which messages call `limit_name`. `field` is the pose's
/// path: "keyframes[3].root_position[0]: 1e+30 m is further than 10000 m from the origin".
void CheckPoseLimits(const Pose& pose, double max_rotation, const std::string& limit_name,
                     const std::string& field);

/// Throws Error(kInvalidArgument, "FIELD.rotations") unless the pose has the skeleton's joints.
void CheckJoints(const Skeleton& skeleton, const Pose& pose, const std::string& field);

/// Checks a key's pose: its joints, and angles of at most kMaxRotation, also of joints that a mask
/// leaves free.
void CheckKeyPose(const Skeleton& skeleton, const Pose& pose, const std::string& field);

/// Checks the poses of a history or a continuation, "FIELD[3]". Angles may be on any branch, as in
/// real motion.
void CheckHistory(const Skeleton& skeleton, std::span<const Pose> poses, const std::string& field);

/// Checks a motion's poses, "frames[7]", with angles of at most kMaxWoundRotation.
void CheckMotionLimits(const Motion& motion);

}  // namespace choreo
