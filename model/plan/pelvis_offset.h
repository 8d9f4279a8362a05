#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/flow/footwork_options.h"

namespace choreo {

/// Of its length: no leg that stands or steps is straighter.
inline constexpr double kStraightestLeg = 0.985;

/// What one frame asks of where the pelvis is. Metres; the floor is y = 0.
struct SupportFrame {
  /// Of a foot that stands: the way from the hip to where its ankle has to be, and the leg's
  /// length.
  struct Leg {
    Eigen::Vector3d to_ankle;
    double length;
  };
  std::vector<Leg> legs;
  std::vector<Eigen::Vector2d> support;  ///< (x, z) of toes and ankles on the floor; none: a flight
  Eigen::Vector3d centre;                ///< of mass, smoothed
};

/// How the pelvis is moved, with all that hangs on it.
struct PelvisRules {
  bool returns = false;        ///< not in the last frame, which is a key
  bool heights_alone = false;  ///< on the floor it stays where a path says
  /// By how much it left the plan in the two frames before the first, oldest first.
  Eigen::Matrix<double, 3, 2> before = Eigen::Matrix<double, 3, 2>::Zero();
  double fps;
  FootworkOptions options = {};
};

/// By how much the pelvis leaves the plan in each frame, [3, frames], metres: the least
/// acceleration and the shortest way (squares) by which legs reach their feet, the zero moment
/// point stays at the feet, and who leaps, from floor to floor within
/// the plan, falls by 9.81 m/s². `centre_before`: as the plan has it
/// in the frame before the first. Of hulls and legs, which are not linear, the nearest points are
/// taken anew in each of a few rounds, so what is missed never grows. Pure.
Eigen::Matrix3Xd PelvisOffset(const std::vector<SupportFrame>& frames,
                              const Eigen::Vector3d& centre_before, const PelvisRules& rules);

}  // namespace choreo
