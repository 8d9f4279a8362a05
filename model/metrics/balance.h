#pragma once

#include <vector>

#include "model/metrics/joint_track.h"
#include "model/motion/skeleton.h"
#include "model/motion/support.h"

/// Whether a dancer has weight: stands on her feet, pushes off, falls and lands. Pure functions of
/// joint positions, so that real motion is measured alike. Thread-safe.
namespace choreo {

/// Height of the floor that a dancer danced on: the 5th percentile over frames of her lower foot,
/// toes or ankle less 5 cm. At least one frame, all four foot joints.
double DancedFloor(const Skeleton& skeleton, const JointTrack& track);

/// Of each frame. `floor`: its height, metres. Throws Error(kInvalidArgument) for a skeleton that
/// BalanceGauge doesn't fit, or no frames.
std::vector<Balance> BalanceOf(const Skeleton& skeleton, double fps, const JointTrack& track,
                               double floor);

struct WeightFigures {
  double hover_share = 0;  ///< frames in which both feet are more than 5 cm above the floor
  /// Median vertical acceleration of the centre of mass in those, m/s^2: -9.81 for who jumps, 0 for
  /// who is carried; NaN without any.
  double hover_acceleration = 0;
  /// The longest time that no joint is less than 15 cm above the floor, seconds. Flights do not
  /// count: times over which the centre of mass accelerates downwards by more than kThrown on
  /// average.
  double longest_hover_s = 0;
  double zmp_outside = 0;     ///< frames whose zero moment point is > 15 cm outside of the feet
  double centre_outside = 0;  ///< frames whose centre of mass is > 10 cm outside of them
  double supported = 0;       ///< frames in which something bears the body (Balance::Supported)
  double contact_frames = 0;  ///< median time that a foot stays on the floor, frames; 0 without
};

/// Frames in which no foot is on the floor are not outside of the feet: they hover. Floor and
/// errors are BalanceOf's.
WeightFigures MeasureWeight(const Skeleton& skeleton, double fps, const JointTrack& track,
                            double floor);

}  // namespace choreo
