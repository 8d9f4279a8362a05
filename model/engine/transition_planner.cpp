#include "model/engine/transition_planner.h"

#include <algorithm>
#include <numbers>

#include "model/motion/rotation.h"
#include "model/motion/way_round.h"

namespace choreo {
namespace {

constexpr double kSwing = 0.14;  // radians a frame: a turn of the whole body in 1.5 s
// Who swings round on a turn of less has no calmer other way, but a somersault or a spin.
constexpr double kLeastSwung = std::numbers::pi / 2;

// Of the two ways round the one that the history's turning leads to; `turn` where it says nothing.
Eigen::Vector3d AsTurning(const Eigen::Vector3d& turn, const TransitionSpec& spec) {
  const size_t history = spec.history.size();
  if (history < 3) return turn;
  const Eigen::Vector3d rate = 0.5 * RotationDifference(spec.history[history - 3].rotations.col(0),
                                                        spec.history[history - 1].rotations.col(0));
  const Eigen::Vector3d expected = std::min<double>(kTurnHorizon, spec.frames) * rate;
  return NearerWayRound(turn, expected);
}

// The most that the root turns in a frame, radians.
double FastestTurn(const TransitionPlan& plan, const TransitionSpec& spec) {
  double fastest = 0;
  Eigen::Vector3d before = spec.history.back().rotations.col(0);
  for (const Pose& pose : plan.poses) {
    const Eigen::Vector3d now = pose.rotations.col(0);
    fastest = std::max(fastest, RotationDifference(before, now).norm());
    before = now;
  }
  return fastest;
}

}  // namespace

TransitionPlan TransitionPlanner::Plan(const TransitionSpec& spec) const {
  if (!spec.target || !spec.target->mask.Asks(0)) return PlanTurning(spec, Eigen::Vector3d::Zero());
  const Eigen::Vector3d turn = AsTurning(
      RotationDifference(spec.history.back().rotations.col(0), spec.target->pose.rotations.col(0)),
      spec);
  TransitionPlan plan = PlanTurning(spec, turn);
  const double fastest = FastestTurn(plan, spec);
  if (fastest < kSwing || turn.norm() < kLeastSwung) return plan;
  TransitionPlan other = PlanTurning(spec, OtherWayRound(turn));
  return FastestTurn(other, spec) < fastest ? other : plan;
}

}  // namespace choreo
