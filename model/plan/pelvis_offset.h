#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "model/plan/footwork_options.h"

namespace choreo {

/// The largest distance from hip to ankle of a standing or stepping leg, as a share of the leg's
/// length.
inline constexpr double kStraightestLeg = 0.985;

/// A frame's centre of mass, metres.
struct BodyCentre {
  Eigen::Vector3d exact, smooth;  ///< falls; is balanced
};

/// One frame's requirements on the pelvis. Metres; the floor is y = 0.
struct SupportFrame {
  /// For a standing foot: the vector from the hip to its ankle's target, and the leg's length.
  struct Leg {
    Eigen::Vector3d to_ankle;
    double length;
  };
  std::vector<Leg> legs;
  std::vector<Eigen::Vector2d> support;  ///< (x, z) of joints on the floor; empty: a flight
  bool carried = false;                  ///< whether other joints than the feet's are among them
  BodyCentre centre;
};

/// Limits on the motion of the pelvis, which moves the whole body.
struct PelvisRules {
  bool returns = false;        ///< zero in the last frame, which is a key
  bool heights_alone = false;  ///< only heights move, as a path fixes the floor position
  /// How many frames before the first one SupportFrame::carried was last true.
  int since_carried = std::numeric_limits<int>::max();
  /// The offset in the two frames before the first, oldest first.
  Eigen::Matrix<double, 3, 2> before = Eigen::Matrix<double, 3, 2>::Zero();
  double fps;
  FootworkOptions options = {};
};

/// Computes the pelvis's offset from the plan, [3, frames], metres. Minimises its squared
/// acceleration and length, subject to three conditions: legs reach their feet; the centre of mass
/// and the zero moment point stay over the feet; jumps fall at 9.81 m/s² and keep their horizontal
/// velocity, from feet to feet, to a key in the air, or from the air to the feet. A body that rises
/// from its knees, hands or seat, or goes down on them, does not jump. `before`: the plan's centre
/// of mass in the two frames before the first, oldest first. Hulls and legs are not linear, so
/// rounds, at most 12, linearise again at their nearest points, until the pelvis moves by less than
/// a tenth of FootworkOptions::reach. Pure.
Eigen::Matrix3Xd PelvisOffset(const std::vector<SupportFrame>& frames,
                              const std::array<BodyCentre, 2>& before, const PelvisRules& rules);

}  // namespace choreo
