#include "model/engine/plan_pace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/motion/kinematics.h"

namespace choreo {
namespace {

// How far each frame gets along a way of these steps at these times.
std::vector<double> Travelled(const std::vector<double>& steps, const std::vector<double>& times) {
  std::vector<double> moved;
  double before = 0;
  for (const double time : times) {
    const auto whole = static_cast<size_t>(std::floor(time + 1));
    double at = std::accumulate(steps.begin(), steps.begin() + static_cast<ptrdiff_t>(whole), 0.0);
    if (whole < steps.size()) at += (time + 1 - static_cast<double>(whole)) * steps[whole];
    moved.push_back(at - before);
    before = at;
  }
  return moved;
}

TEST(EvenTimes, AreTheFramesThemselvesWhereNothingIsTooFast) {
  const std::vector<double> steps(30, 0.05);
  const std::vector<double> times = EvenTimes(steps, 0.05);
  for (size_t t = 0; t < times.size(); ++t) EXPECT_EQ(times[t], static_cast<double>(t));
  EXPECT_TRUE(EvenTimes({}, 1).empty());
}

TEST(EvenTimes, ASwingTakesItsTimeAndTheEndsKeepTheirPace) {
  std::vector<double> steps(60, 0.02);
  std::fill(steps.begin() + 20, steps.begin() + 30, 0.1);
  const std::vector<double> times = EvenTimes(steps, 0.05);
  ASSERT_EQ(times.size(), steps.size());
  EXPECT_EQ(times.back(), 59);
  EXPECT_TRUE(std::ranges::is_sorted(times));
  const std::vector<double> moved = Travelled(steps, times);
  EXPECT_NEAR(std::accumulate(moved.begin(), moved.end(), 0.0), 50 * 0.02 + 10 * 0.1, 1e-9);
  for (const double step : moved) EXPECT_LE(step, 0.05 + 1e-9);
  EXPECT_NEAR(moved.front(), 0.02, 0.002);
  EXPECT_NEAR(moved.back(), 0.02, 0.002);
}

TEST(EvenTimes, AWayThatIsTooLongForItsTimeIsEven) {
  std::vector<double> steps(12, 0.2);
  steps[5] = steps[6] = 0.8;  // 0.3 a frame: six times what is asked
  const std::vector<double> moved = Travelled(steps, EvenTimes(steps, 0.05));
  for (const double step : moved) EXPECT_LE(step, 1.3 * 0.3 * 1.05);
}

TEST(EvenTimes, ASingleStepStaysWhatItIs) {
  EXPECT_EQ(EvenTimes(std::vector{5.0}, 0.1), std::vector{0.0});
}

// The root goes `steps` along X, from rest.
std::vector<Pose> Walk(const std::vector<double>& steps) {
  std::vector<Pose> poses;
  Pose pose = RestPose(Skeleton::Smpl24());
  for (const double step : steps) {
    pose.root_position.x() += step;
    poses.push_back(pose);
  }
  return poses;
}

// Steps of a dancer who stands but for a swing of up to 4.5 m/s in the middle of 60 frames.
std::vector<double> Swing() {
  std::vector<double> steps(60, 0.01);
  for (int t = 22; t < 38; ++t)
    steps[static_cast<size_t>(t)] += 0.07 * (1 + std::cos(2 * M_PI * (t - 30) / 16));
  return steps;
}

TEST(EvenPaceTest, IsNoFasterThanDancersAreAndEndsOnTheKey) {
  const std::vector<Pose> plan = Walk(Swing()), before(10, RestPose(Skeleton::Smpl24()));
  const std::vector<Pose> even = EvenPace(Skeleton::Smpl24(), before, plan, 30);
  ASSERT_EQ(even.size(), plan.size());
  EXPECT_NEAR(even.back().root_position.x(), plan.back().root_position.x(), 1e-12);
  double last = 0, fastest = 0;
  for (const Pose& pose : even) {
    fastest = std::max(fastest, 30 * (pose.root_position.x() - last));
    last = pose.root_position.x();
  }
  EXPECT_LT(fastest, 1.7);  // the cubic overshoots a little
  EXPECT_GT(fastest, 1.5);
}

TEST(EvenPaceTest, IsAsFastAsTheDancerWas) {
  const std::vector<Pose> plan = Walk(Swing());
  std::vector<Pose> before(2, RestPose(Skeleton::Smpl24()));
  before[0].root_position.x() = -0.16;
  const std::vector<Pose> even = EvenPace(Skeleton::Smpl24(), before, plan, 30);
  for (size_t t = 0; t < plan.size(); ++t)
    EXPECT_EQ(even[t].root_position.x(), plan[t].root_position.x());
}

}  // namespace
}  // namespace choreo
