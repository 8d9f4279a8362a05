#include "model/engine/plan_timing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/dance/quality_report.h"
#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// A dancer who turns and walks on evenly: without timing she has no beats of her own.
std::vector<Pose> EvenWalk(int frames) {
  std::vector<Pose> plan(static_cast<size_t>(frames), RestPose(Skeleton::Smpl24()));
  for (int t = 0; t < frames; ++t) {
    Pose& pose = plan[static_cast<size_t>(t)];
    pose.root_position.x() += 0.02 * (t + 1);
    pose.rotations.col(16) = Eigen::Vector3d(0, 0, 0.01 * (t + 1));
  }
  return plan;
}

std::vector<double> EveryFifteen(double first, double last) {
  std::vector<double> beats;
  for (double beat = first; beat < last; beat += 15) beats.push_back(beat);
  return beats;
}

TEST(PlanTime, KeepsTheEndsAndNeverRunsBackwards) {
  for (const int frames : {2, 7, 30, 90}) {
    const std::vector<double> beats = EveryFifteen(-11, frames + 15);
    EXPECT_NEAR(PlanTime(beats, frames, -1), -1, 1e-12);
    EXPECT_NEAR(PlanTime(beats, frames, frames - 1), frames - 1, 1e-12);
    for (double t = -1; t < frames - 1; t += 0.1) {
      EXPECT_LT(PlanTime(beats, frames, t), PlanTime(beats, frames, t + 0.1));
      EXPECT_LT(std::abs(PlanTime(beats, frames, t) - t), 3);
    }
  }
}

TEST(PlanTime, RunsEvenlyWithoutBeatsAndWhereTheMusicPauses) {
  for (double t = -1; t < 30; t += 0.5) EXPECT_EQ(PlanTime({}, 31, t), t);
  const std::vector<double> pause = {-100, 200};
  for (double t = -1; t < 30; t += 0.5) EXPECT_EQ(PlanTime(pause, 31, t), t);
}

TEST(TimeToBeats, SpeedPeaksOnTheBeats) {
  const std::vector<Pose> plan = EvenWalk(90);
  const std::vector<Pose> before = {RestPose(Skeleton::Smpl24())};
  const std::vector<double> beats = EveryFifteen(-8, 110);
  const std::vector<Pose> timed = TimeToBeats(before, plan, beats);
  ASSERT_EQ(timed.size(), plan.size());
  std::vector<float> speeds;
  for (size_t t = 1; t < timed.size(); ++t) {
    speeds.push_back(
        static_cast<float>((timed[t].root_position - timed[t - 1].root_position).norm()));
  }
  const std::vector<int64_t> peaks = KinematicBeats(speeds, 30);
  ASSERT_GE(peaks.size(), 5U);
  for (const int64_t peak : peaks) {
    double nearest = 1e9;
    for (const double beat : beats)
      nearest = std::min(nearest, std::abs(beat - static_cast<double>(peak)));
    EXPECT_LE(nearest, 2) << peak;
  }
  EXPECT_NEAR((timed.back().root_position - plan.back().root_position).norm(), 0, 1e-9);
  EXPECT_NEAR((timed.back().rotations - plan.back().rotations).norm(), 0, 1e-9);
}

TEST(TimeToBeats, AnEvenCurveStaysOnItself) {
  const std::vector<Pose> plan = EvenWalk(40);
  const std::vector<Pose> timed =
      TimeToBeats(std::vector{RestPose(Skeleton::Smpl24())}, plan, EveryFifteen(-8, 60));
  for (const Pose& pose : timed) {
    // Arm and feet keep step: both are a hundredth and two of the same time.
    EXPECT_NEAR(pose.rotations(2, 16) / 0.01, (pose.root_position.x()) / 0.02, 1e-2);
  }
}

}  // namespace
}  // namespace choreo
