#include <gtest/gtest.h>

#include <cmath>

#include "model/motion/kinematic_beats.h"
#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"
#include "model/plan/plan_stages.h"

namespace choreo::beat_timing_test {

// A dancer who turns and walks evenly: without timing she has no beats of her own.
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

double Time(std::span<const double> beats, int frames, bool keyed, double t) {
  return BeatTime(
      {.skeleton = Skeleton::Smpl24(), .history = {}, .beats = beats, .keyed = keyed, .fps = 30},
      frames, t);
}

TEST(BeatTiming, KeepsTheEndsAndNeverRunsBackwards) {
  for (const int frames : {2, 7, 30, 32, 45, 60, 75, 90}) {
    for (const double first : {-11.0, -16.0}) {  // the second: on all keys of whole seconds' ways
      for (const bool keyed : {false, true}) {
        const std::vector<double> beats = EveryFifteen(first, frames + 15);
        const auto time = [&](double t) { return Time(beats, frames, keyed, t); };
        EXPECT_NEAR(time(-1), -1, 1e-12);
        EXPECT_NEAR(time(frames - 1), frames - 1, 1e-12);
        for (double t = -1; t < frames - 1; t += 0.1) {
          EXPECT_LT(time(t), time(t + 0.1)) << frames << " " << first << " " << t;
          EXPECT_LT(std::abs(time(t) - t), 4) << frames << " " << first << " " << t;
        }
      }
    }
  }
}

TEST(KeyHit, RunsFromTheUsualSpeedToItsOwn) {
  for (const double hit : {0.0, 0.5, 1.0, 3.0}) {
    EXPECT_EQ(HitTime(0, hit), 0);
    EXPECT_EQ(HitTime(1, hit), 1);
    EXPECT_NEAR(HitTime(1e-6, hit) / 1e-6, 1, 1e-4);
    EXPECT_NEAR((1 - HitTime(1 - 1e-6, hit)) / 1e-6, hit, 1e-4);
    for (double u = 0; u < 0.995; u += 0.01) EXPECT_LT(HitTime(u, hit), HitTime(u + 0.01, hit));
  }
}

TEST(KeyHit, TimesTheFramesBeforeTheKeyAlone) {
  const std::vector<Pose> history = {RestPose(Skeleton::Smpl24())};
  const PlanContext context{.skeleton = Skeleton::Smpl24(), .history = history, .fps = 30};
  for (const int frames : {60, 10}) {
    const std::vector<Pose> even = EvenWalk(frames);
    const auto x = [](const Pose& pose) { return pose.root_position.x(); };
    const int first = std::max(0, frames - 24);
    for (const double hit : {0.0, 1.0, 3.0}) {
      std::vector<Pose> plan = even;
      HitKey(context, hit, &plan);
      for (int t = 0; t < first; ++t) EXPECT_EQ(x(plan[t]), x(even[t])) << t;
      EXPECT_NEAR(x(plan.back()), x(even.back()), 1e-9);
      const double step = x(plan.back()) - x(plan[frames - 2]);
      const int middle = (first + frames) / 2;
      if (hit == 0) {
        EXPECT_LT(step, 0.005);
        EXPECT_GT(x(plan[middle]), x(even[middle]) + 0.01);
      } else if (hit == 1) {
        EXPECT_EQ(x(plan[middle]), x(even[middle]));
      } else {
        EXPECT_GT(step, 0.04);
        EXPECT_LT(x(plan[middle]), x(even[middle]) - 0.01);
      }
    }
  }
}

TEST(BeatTiming, RunsEvenlyWithoutBeatsAndWhereTheMusicPauses) {
  for (double t = -1; t < 30; t += 0.5) EXPECT_EQ(Time({}, 31, true, t), t);
  const std::vector<double> pause = {-100, 200};
  for (double t = -1; t < 30; t += 0.5) EXPECT_EQ(Time(pause, 31, true, t), t);
}

TEST(BeatTiming, RunsFastestAtKeysThatStandOnBeats) {
  const auto pace = [](std::span<const double> beats, int frames, bool keyed, double t) {
    return (Time(beats, frames, keyed, t + 0.05) - Time(beats, frames, keyed, t)) / 0.05;
  };
  const std::vector<double> on = EveryFifteen(-16, 100), off = EveryFifteen(-9, 100);
  // 60 frames from key to key, both on a beat: 1 + 0.25 + 0.75 at each.
  EXPECT_NEAR(pace(on, 60, true, 58.95), 2, 0.05);
  EXPECT_NEAR(pace(on, 60, true, -1), 2, 0.05);
  EXPECT_NEAR(pace(on, 60, false, 58.95), 1.25, 0.05);
  EXPECT_LT(pace(off, 60, true, 58.95), 1.25);
  EXPECT_NEAR(pace(on, 30, true, 28.95), 1.25, 0.05);  // there is no room
}

TEST(BeatTiming, SpeedPeaksOnTheBeats) {
  const std::vector<Pose> plan = EvenWalk(90);
  const std::vector<Pose> before = {RestPose(Skeleton::Smpl24())};
  const std::vector<double> beats = EveryFifteen(-8, 110);
  std::vector<Pose> timed = plan;
  TimeToBeats({.skeleton = Skeleton::Smpl24(), .history = before, .beats = beats, .fps = 30},
              &timed);
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

TEST(BeatTiming, KeepsToAPathAndBendsTheTimeOfLimbsAlone) {
  const std::vector<Pose> plan = EvenWalk(90);
  const std::vector<Pose> before = {RestPose(Skeleton::Smpl24())};
  const std::vector<double> beats = EveryFifteen(-8, 110);
  const auto timed = [&](bool has_path, bool has_heights) {
    std::vector<Pose> poses = plan;
    for (size_t t = 0; t < poses.size(); ++t)
      poses[t].root_position.y() += 0.001 * static_cast<double>(t);
    TimeToBeats({.skeleton = Skeleton::Smpl24(),
                 .history = before,
                 .beats = beats,
                 .has_path = has_path,
                 .has_heights = has_heights,
                 .fps = 30},
                &poses);
    return poses;
  };
  const std::vector<Pose> free = timed(false, false), led = timed(true, false),
                          lifted = timed(true, true);
  double bent = 0;
  for (size_t t = 0; t < plan.size(); ++t) {
    EXPECT_EQ(led[t].rotations, free[t].rotations);
    EXPECT_NEAR(led[t].root_position.x(), plan[t].root_position.x(), 1e-12);
    EXPECT_EQ(led[t].root_position.y(), free[t].root_position.y());
    EXPECT_NEAR(lifted[t].root_position.y(),
                plan[t].root_position.y() + 0.001 * static_cast<double>(t), 1e-12);
    bent = std::max(bent, std::abs(free[t].root_position.x() - plan[t].root_position.x()));
  }
  EXPECT_GT(bent, 0.01);
}

TEST(BeatTiming, AnEvenCurveStaysOnItself) {
  const std::vector<Pose> plan = EvenWalk(40);
  const std::vector<Pose> before = {RestPose(Skeleton::Smpl24())};
  const std::vector<double> beats = EveryFifteen(-8, 60);
  std::vector<Pose> timed = plan;
  TimeToBeats(
      {.skeleton = Skeleton::Smpl24(), .history = before, .beats = beats, .keyed = true, .fps = 30},
      &timed);
  for (const Pose& pose : timed) {
    // Arm and feet keep step: both are a hundredth and two of the same time.
    EXPECT_NEAR(pose.rotations(2, 16) / 0.01, (pose.root_position.x()) / 0.02, 1e-2);
  }
}

}  // namespace choreo::beat_timing_test
