#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// The limits of human movement, for judging motion.
namespace choreo {

/// Speed of the fastest joint, metres per second. In recorded dances only one frame in 10,000 has a
/// faster hand.
inline constexpr double kFastestJoint = 11;
/// Mean speed of all joints, metres per second. The fastest frame of recorded dances has 4.66.
inline constexpr double kFastestBody = 4.7;
/// Seconds without floor contact: the flight of a jump 0.6 m high.
inline constexpr double kLongestFlight = 0.7;

/// A joint's fastest movement between two successive poses.
struct FastStep {
  double m_per_s = 0;
  int joint = 0;
  size_t to = 0;  ///< the index of the later pose
};

/// Finds the fastest step from `before` through `poses`.
FastStep FindFastestStep(const Skeleton& skeleton, const Pose& before, std::span<const Pose> poses,
                         double fps);

/// The larger of two ratios: the fastest joint's speed over kFastestJoint, and the joints' mean
/// speed over kFastestBody. `speeds`: [joints], metres per second.
double SpeedExcess(const Eigen::RowVectorXd& speeds);
/// The largest SpeedExcess of the steps from `before` through `poses`.
double SpeedExcess(const Skeleton& skeleton, const Pose& before, std::span<const Pose> poses,
                   double fps);

}  // namespace choreo
