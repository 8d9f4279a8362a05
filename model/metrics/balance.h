#pragma once

#include <vector>

#include "model/metrics/joint_track.h"
#include "model/motion/skeleton.h"
#include "model/motion/support.h"

/// Measures whether a dancer seems to have weight: whether the feet support the body, and whether
/// it pushes off, falls and lands as a real one does. Pure functions of joint positions, so real
/// motion is measured in the same way. Thread-safe.
namespace choreo {

/// Height of the floor: the 5th percentile over frames of the lower foot, toes or ankle less 5 cm.
/// Needs at least one frame and all four foot joints.
double DancedFloor(const Skeleton& skeleton, const JointTrack& track);

/// The balance of each frame. `floor`: its height, metres. Throws Error(kInvalidArgument) for a
/// skeleton that BalanceGauge doesn't fit, or no frames.
std::vector<Balance> BalanceOf(const Skeleton& skeleton, double fps, const JointTrack& track,
                               double floor);

struct WeightFigures {
  double hover_share = 0;  ///< frames in which both feet are more than 5 cm above the floor
  /// Median vertical acceleration of the centre of mass in those frames, m/s^2: -9.81 for a jump, 0
  /// for a body that floats; NaN without such frames.
  double hover_acceleration = 0;
  /// The longest time during which no joint is within 15 cm of the floor, seconds, excluding
  /// flights: times over which the centre of mass accelerates downwards by more than kThrown on
  /// average.
  double longest_hover_s = 0;
  double zmp_outside = 0;     ///< frames whose zero moment point is > 15 cm outside the feet
  double centre_outside = 0;  ///< frames whose centre of mass is > 10 cm outside the feet
  double supported = 0;       ///< frames in which something supports the body (Balance::Supported)
  double contact_frames =
      0;  ///< median time that a foot stays on the floor, frames; 0 without contacts
};

/// Frames without a foot on the floor count as hovering, not as outside the feet. Takes the floor
/// and throws like BalanceOf.
WeightFigures MeasureWeight(const Skeleton& skeleton, double fps, const JointTrack& track,
                            double floor);

}  // namespace choreo
