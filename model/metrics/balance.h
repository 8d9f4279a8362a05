#pragma once

#include <vector>

#include "model/metrics/joint_track.h"
#include "model/motion/floor/hovers.h"
#include "model/motion/skeleton.h"

/// Measures whether a dancer seems to have weight: whether the feet support the body, and whether
/// it pushes off, falls and lands like a real one. Pure functions of joint positions, of generated
/// and real motion alike. Thread-safe.
namespace choreo {

/// The floor's height, metres: the 5th percentile over frames of the lower foot, where a foot is
/// its toes or its ankle less 5 cm, whichever is lower. Needs at least one frame and all four foot
/// joints.
double DancedFloor(const Skeleton& skeleton, const JointTrack& track);

struct WeightFigures {
  double hover_share = 0;  ///< share of frames with both feet more than 5 cm above the floor
  /// Median vertical acceleration of the centre of mass in hover_share's frames, m/s^2: -9.81 for a
  /// jump, 0 for a floating body; NaN without such frames.
  double hover_acceleration = 0;
  /// The longest time without any joint within 15 cm of the floor, seconds. Does not count flights,
  /// in which the centre of mass accelerates downwards by more than kThrown on average.
  double longest_hover_s = 0;
  double zmp_outside = 0;  ///< share of frames with the zero moment point > 15 cm outside the feet
  double centre_outside = 0;  ///< share of frames with the centre of mass > 10 cm outside the feet
  double supported = 0;  ///< share of frames in which the body is supported (Balance::Supported)
  double contact_frames =
      0;  ///< median length of a foot's floor contacts, frames; 0 without contacts
};

/// Measures a dance. Frames without a foot on the floor count as hovering, not as outside the feet.
/// `floor` and errors are as in BalanceOf.
WeightFigures MeasureWeight(const Skeleton& skeleton, double fps, const JointTrack& track,
                            double floor);

}  // namespace choreo
