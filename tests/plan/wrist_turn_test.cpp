#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/motion/kinematics/mirror.h"
#include "model/motion/rotation.h"
#include "model/plan/plan_stages.h"

namespace choreo::wrist_turn_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }
int LeftWrist() { return Body().Find("left_wrist"); }
int RightWrist() { return Body().Find("right_wrist"); }

// Both shoulders and elbows swing to and fro, each by `swing` radians.
std::vector<Pose> Swing(int frames, double swing) {
  std::vector<Pose> plan;
  for (int i = 0; i < frames; ++i) {
    Pose pose = RestPose(Body());
    const double turn = swing * std::sin(0.2 * i);
    pose.rotations.col(Body().left_shoulder).z() = turn;
    pose.rotations.col(Body().right_shoulder).z() = -turn;
    pose.rotations.col(Body().left_elbow).y() = -turn;
    pose.rotations.col(Body().right_elbow).y() = turn;
    plan.push_back(pose);
  }
  return plan;
}

std::vector<Pose> Turned(std::vector<Pose> plan, const TransitionNoise& noise,
                         std::vector<Pose> history = {}) {
  if (history.empty()) history.assign(10, plan.front());
  TurnWrists({.skeleton = Body(), .history = history, .fps = 30, .noise = noise}, &plan);
  return plan;
}

TEST(TurnWrists, TurnAsFarAsRecordedOnes) {
  const std::vector<Pose> plan = Turned(Swing(20000, 1), {.seed = 3, .temperature = 1});
  const WristOptions usual;
  for (const int wrist : {LeftWrist(), RightWrist()}) {
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    for (const Pose& pose : plan) squares += pose.rotations.col(wrist).cwiseAbs2();
    const Eigen::Vector3d spread = (squares / static_cast<double>(plan.size())).cwiseSqrt();
    EXPECT_NEAR(spread.x(), usual.twist, 0.1 * usual.twist);
    EXPECT_NEAR(spread.y(), usual.deviation, 0.1 * usual.deviation);
    EXPECT_NEAR(spread.z(), usual.flexion, 0.1 * usual.flexion);
  }
}

TEST(TurnWrists, RestWithTheirArms) {
  std::vector<Pose> moving = Turned(Swing(60, 1), {.seed = 3, .temperature = 1});
  const std::vector<Pose> resting =
      Turned(std::vector<Pose>(30, moving.back()), {.seed = 3, .temperature = 1}, moving);
  for (const Pose& pose : resting)
    EXPECT_LT((pose.rotations - moving.back().rotations).norm(), 1e-9);
}

TEST(TurnWrists, ContinueWithoutAJolt) {
  const std::vector<Pose> plan = Swing(120, 1);
  std::vector<Pose> danced =
      Turned({plan.begin(), plan.begin() + 60}, {.seed = 3, .temperature = 1});
  const std::vector<Pose> rest = Turned({plan.begin() + 60, plan.end()},
                                        {.seed = 3, .first_frame = 60, .temperature = 1}, danced);
  danced.insert(danced.end(), rest.begin(), rest.end());
  double jolt = 0, usual = 0;
  for (size_t i = 2; i < danced.size(); ++i) {
    const auto at = [&](size_t frame) { return danced[frame].rotations.col(LeftWrist()); };
    const double change = (at(i) - 2 * at(i - 1) + at(i - 2)).norm();
    (i == 60 || i == 61 ? jolt : usual) = std::max(i == 60 || i == 61 ? jolt : usual, change);
  }
  EXPECT_GT(usual, 0.01);
  EXPECT_LT(jolt, usual);
}

TEST(TurnWrists, TheMeanMotionLeavesThemStraight) {
  std::vector<Pose> history(10, RestPose(Body()));
  for (Pose& pose : history) pose.rotations.col(LeftWrist()).z() = 0.8;
  const std::vector<Pose> plan = Turned(Swing(300, 1), {.temperature = 0}, history);
  EXPECT_GT(plan[3].rotations.col(LeftWrist()).norm(), 0.5);
  EXPECT_LT(plan.back().rotations.col(LeftWrist()).norm(), 0.01);
  EXPECT_LT(plan.back().rotations.col(RightWrist()).norm(), 1e-12);
}

// The history of a file may have a hand that waves by itself, and wrists beyond half a turn.
TEST(TurnWrists, TameWhatTheHistoryDoes) {
  std::vector<Pose> waves(10, RestPose(Body())), winds = waves;
  for (size_t i = 0; i < 10; ++i) {
    waves[i].rotations.col(LeftWrist()).z() = 0.15 * static_cast<double>(i);
    winds[i].rotations.col(LeftWrist()).z() = 2.7 + 0.05 * static_cast<double>(i);
  }
  for (const auto& history : {waves, winds}) {
    const double before = history.back().rotations.col(LeftWrist()).norm();
    for (const Pose& pose : Turned(Swing(60, 1), {.temperature = 0}, history))
      EXPECT_LT(pose.rotations.col(LeftWrist()).norm(), before + 0.6);
  }
}

TEST(TurnWrists, NeedNoArmsAndNoLevelArms) {
  Skeleton hangs = Body();
  for (const int wrist : {LeftWrist(), RightWrist()}) hangs.offsets.col(wrist) << 0, -0.25, 0;
  std::vector<Pose> plan = Swing(30, 1);
  std::vector<Pose> history(1, plan.front());
  history[0].rotations.col(LeftWrist()).z() = 0.8;
  TurnWrists({.skeleton = hangs, .history = history, .fps = 30, .noise = {.temperature = 0}},
             &plan);
  EXPECT_NEAR(plan[0].rotations.col(LeftWrist()).norm(), 0.8, 0.1);
  Skeleton armless = Body();
  armless.left_elbow = -1;
  TurnWrists({.skeleton = armless, .history = history, .fps = 30}, &plan);
  EXPECT_TRUE(plan[10].rotations.allFinite());
}

TEST(TurnWrists, DifferFromSeedToSeed) {
  const auto last = [](uint64_t seed) {
    return Turned(Swing(100, 1), {.seed = seed, .temperature = 1}).back().rotations;
  };
  EXPECT_EQ(last(1), last(1));
  EXPECT_GT((last(1) - last(2)).norm(), 0.1);
}

// With the history's wrists mirrored, their usual way back is mirrored, too.
TEST(TurnWrists, TheRightWristIsTheLeftOnesMirrorImage) {
  std::vector<Pose> history(10, RestPose(Body()));
  for (Pose& pose : history) {
    pose.rotations.col(LeftWrist()) << 0.2, 0.4, -0.6;
    pose.rotations.col(RightWrist()) << 0.2, -0.4, 0.6;
  }
  const Pose end = Turned(Swing(20, 1), {.temperature = 0}, history).back();
  const Pose mirrored = Mirror(Body(), end);
  EXPECT_LT((end.rotations - mirrored.rotations).norm(), 1e-9);
}

}  // namespace choreo::wrist_turn_test
