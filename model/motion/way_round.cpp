#include "model/motion/way_round.h"

#include <numbers>

namespace choreo {
namespace {

constexpr double kLeastTurn = 1e-3;  // radians

}  // namespace

Eigen::Vector3d OtherWayRound(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  return angle < kLeastTurn ? turn : turn * (1 - 2 * std::numbers::pi / angle);
}

Eigen::Vector3d NearerWayRound(const Eigen::Vector3d& turn, const Eigen::Vector3d& expected) {
  const Eigen::Vector3d other = OtherWayRound(turn);
  return (other - expected).squaredNorm() < (turn - expected).squaredNorm() ? other : turn;
}

}  // namespace choreo
