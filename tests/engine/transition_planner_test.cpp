#include "model/engine/transition_planner.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"

// Which way round a plan turns. The planner here turns evenly, or all at once where a test says so.
namespace choreo {
namespace {

constexpr int kFrames = 60;

class TurningPlanner : public TransitionPlanner {
 public:
  using Swings = std::function<bool(const Eigen::Vector3d& turn)>;
  explicit TurningPlanner(Swings swings) : swings_(std::move(swings)) {}
  mutable std::vector<double> asked;  // about the vertical axis

 private:
  TransitionPlan PlanTurning(const TransitionSpec& spec,
                             const Eigen::Vector3d& turn) const override {
    asked.push_back(turn.y());
    TransitionPlan plan;
    for (int frame = 1; frame <= spec.frames; ++frame) {
      Pose pose = spec.history.back();
      const double share = swings_(turn) ? frame >= spec.frames / 2 : double(frame) / spec.frames;
      pose.rotations.col(0) = ExpFromQuaternion(QuaternionFromExp(pose.rotations.col(0)) *
                                                QuaternionFromExp(share * turn));
      plan.poses.push_back(pose);
    }
    return plan;
  }
  Swings swings_;
};

// Ten frames that turn by `rate` each, then a key `angle` farther on.
TransitionSpec Turning(double rate, double angle) {
  const Skeleton& body = Skeleton::Smpl24();
  TransitionSpec spec;
  spec.frames = kFrames;
  for (int t = -9; t <= 0; ++t) {
    Pose pose = RestPose(body);
    pose.rotations.col(0) = Eigen::Vector3d(0, rate * t, 0);
    spec.history.push_back(pose);
  }
  spec.target = Target{RestPose(body), {}};
  spec.target->pose.rotations.col(0) = Eigen::Vector3d(0, angle, 0);
  return spec;
}

const auto kCalm = [](const Eigen::Vector3d&) { return false; };

TEST(TransitionPlanner, GoesTheShorterWayUnlessTheDancerTurnsTheOther) {
  for (const auto& [rate, angle, turned] :
       {std::array{0.0, 2.5, 2.5}, {0.1, 2.5, 2.5}, {-0.1, 2.5, 2.5 - 2 * std::numbers::pi}}) {
    const TurningPlanner planner(kCalm);
    const TransitionPlan plan = planner.Plan(Turning(rate, angle));
    ASSERT_EQ(planner.asked.size(), 1U) << "a calm plan is made once";
    EXPECT_NEAR(planner.asked[0], turned, 1e-9);
    EXPECT_NEAR(plan.poses[0].rotations(1, 0), turned / kFrames, 1e-9);
  }
}

TEST(TransitionPlanner, GoesTheOtherWayWhereThatSwingsLess) {
  const TurningPlanner planner([](const Eigen::Vector3d& turn) { return turn.y() > 0; });
  const TransitionPlan plan = planner.Plan(Turning(0, 1.6));
  ASSERT_EQ(planner.asked.size(), 2U);
  EXPECT_NEAR(planner.asked[1], 1.6 - 2 * std::numbers::pi, 1e-9);
  EXPECT_LT(plan.poses[0].rotations(1, 0), 0);
}

TEST(TransitionPlanner, KeepsItsWayWhereTheOtherSwingsMore) {
  const TurningPlanner planner([](const Eigen::Vector3d&) { return true; });
  const TransitionPlan plan = planner.Plan(Turning(0, 1.6));
  ASSERT_EQ(planner.asked.size(), 2U);
  EXPECT_NEAR(plan.poses.back().rotations(1, 0), 1.6, 1e-9);
}

// Leaning differently and swinging: the other way round would be a somersault.
TEST(TransitionPlanner, LessThanAQuarterTurnHasNoOtherWay) {
  const TurningPlanner planner([](const Eigen::Vector3d& turn) { return turn.x() > 0; });
  TransitionSpec spec = Turning(0, 0);
  spec.target->pose.rotations.col(0) = Eigen::Vector3d(1.5, 0, 0);
  const TransitionPlan plan = planner.Plan(spec);
  EXPECT_EQ(planner.asked.size(), 1U);
  EXPECT_NEAR(plan.poses.back().rotations(0, 0), 1.5, 1e-9);
}

// Two keys that face the same way, to what computing leaves over: a whole turn about such an axis
// would end elsewhere.
TEST(TransitionPlanner, NextToNoTurnHasNoOtherWay) {
  for (const double angle : {0.0, 5e-7, -2e-5}) {
    const TurningPlanner planner(kCalm);
    planner.Plan(Turning(0.3, angle));
    EXPECT_NEAR(planner.asked[0], angle, 1e-12);
  }
}

TEST(TransitionPlanner, WhoIsAskedForNoTurnIsAskedOnce) {
  for (const bool key : {false, true}) {
    TransitionSpec spec = Turning(0.1, 2);
    if (key) {
      spec.target->mask.joints.assign(24, true);
      spec.target->mask.joints[0] = false;
    } else {
      spec.target.reset();
    }
    const TurningPlanner planner([](const Eigen::Vector3d&) { return true; });
    planner.Plan(spec);
    EXPECT_EQ(planner.asked, std::vector<double>{0});
  }
}

}  // namespace
}  // namespace choreo
