#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// What bodies reach, for judging motion.
namespace choreo {

/// Metres a second of any joint: in recorded dances hands, the fastest, are slower in all but one
/// of 10,000 frames.
inline constexpr double kFastestJoint = 11;
/// Metres a second, the mean of all joints: in recorded dances the fastest frame has 4.66.
inline constexpr double kFastestBody = 4.7;
/// Seconds without touching the floor: of a jump 0.6 m high.
inline constexpr double kLongestFlight = 0.7;

/// The fastest step of a joint between two successive poses.
struct FastStep {
  double m_per_s = 0;
  int joint = 0;
  size_t to = 0;  ///< the index of the pose that it leads to
};

/// The fastest step of `poses`, of which the first follows `before`.
FastStep FindFastestStep(const Skeleton& skeleton, const Pose& before, std::span<const Pose> poses,
                         double fps);

/// The speed of the fastest joint, or of the whole body, in units of the fastest that bodies reach.
/// `speeds`: of all joints, metres a second.
double SpeedExcess(const Eigen::RowVectorXd& speeds);

}  // namespace choreo
