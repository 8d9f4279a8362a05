#pragma once

#include <Eigen/Core>

/// Two rotations about one axis end alike: by an angle, and by the rest of the whole turn the other
/// way. Which of them a dancer takes. Rotation vectors, radians; pure functions.
namespace choreo {

/// Frames that a dancer goes on turning as she does.
inline constexpr double kTurnHorizon = 12;

/// The other of the two turns that end alike; `turn` itself where it is next to none, whose axis is
/// noise.
Eigen::Vector3d OtherWayRound(const Eigen::Vector3d& turn);

/// Of the two, the one nearer to `expected`.
Eigen::Vector3d NearerWayRound(const Eigen::Vector3d& turn, const Eigen::Vector3d& expected);

}  // namespace choreo
