#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/motion/kinematics/kinematic_beats.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "model/plan/plan_stages.h"

namespace choreo::beat_timing_test {

// A dancer who turns and walks evenly, and without timing has no own beats.
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

std::vector<double> Times(std::span<const double> beats, std::span<const double> speeds,
                          std::span<const double> paces = {}) {
  return TimesOnBeats({.skeleton = Skeleton::Smpl24(), .history = {}, .beats = beats, .fps = 30},
                      speeds, paces);
}

// A dancer with own beats, `late` frames after the music's.
std::vector<double> Swaying(int frames, double period, double late) {
  std::vector<double> speeds;
  for (int t = 0; t < frames; ++t)
    speeds.push_back(0.02 + 0.01 * std::cos(2 * M_PI * (t - late) / period));
  return speeds;
}

TEST(BeatTiming, KeepsTheEndAndStaysWithinTheAccent) {
  const double accent = PlanOptions().accent;
  for (const int frames : {1, 2, 7, 30, 32, 45, 60, 75, 90, 300}) {
    for (const double first : {-11.0, -16.0}) {
      for (const double late : {0.0, 4.0, 7.0}) {
        const std::vector<double> beats = EveryFifteen(first, frames + 15);
        const std::vector<double> times = Times(beats, Swaying(frames, 17, late));
        double before = -1, pace = 1;
        for (const double time : times) {
          EXPECT_NEAR(time - before, 1, accent + 1e-9);
          EXPECT_NEAR(time - before, pace, accent / 4 + 1e-9);
          pace = time - before;
          before = time;
        }
        EXPECT_NEAR(times.back(), frames - 1, 1e-9);
      }
    }
  }
}

// Where a body is as fast as bodies get, time does not run faster.
TEST(BeatTiming, StaysWithinThePacesThatBodiesReach) {
  const std::vector<double> beats = EveryFifteen(-8, 110), speeds = Swaying(90, 15, 9);
  std::vector<double> paces(90, 2);
  std::fill(paces.begin() + 30, paces.begin() + 50, 1.1);
  const auto fastest = [&](std::span<const double> times) {
    double most = 0;
    for (size_t t = 1; t < times.size(); ++t)
      if (times[t] >= 30 && times[t] < 49) most = std::max(most, times[t] - times[t - 1]);
    return most;
  };
  EXPECT_GT(fastest(Times(beats, speeds)), 1.2);
  EXPECT_LE(fastest(Times(beats, speeds, paces)), 1.1);
}

TEST(BeatTiming, MovesTheDancersOwnBeatsOntoTheMusics) {
  const std::vector<double> beats = EveryFifteen(-8, 110);
  for (const double late : {-4.0, -2.0, 2.0, 4.0}) {
    const std::vector<double> speeds = Swaying(90, 15, 7 + late);
    const std::vector<double> times = Times(beats, speeds);
    std::vector<float> timed;
    for (size_t t = 1; t < times.size(); ++t) {
      const double pace = times[t] - times[t - 1];
      timed.push_back(static_cast<float>(pace * speeds[static_cast<size_t>(times[t])]));
    }
    int hits = 0, peaks = 0;
    for (const int64_t peak : KinematicBeats(timed, 30)) {
      if (peak < 15 || peak > 75) continue;  // time takes a while to turn
      ++peaks;
      hits += std::ranges::any_of(
          beats, [&](double beat) { return std::abs(beat - static_cast<double>(peak)) <= 2; });
    }
    EXPECT_GE(peaks, 3) << late;
    EXPECT_EQ(hits, peaks) << late;
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
  const std::vector<double> pause = {-100, 200}, speeds = Swaying(31, 15, 4);
  for (const std::vector<double>& beats : {std::vector<double>(), pause}) {
    const std::vector<double> times = Times(beats, speeds);
    for (size_t t = 0; t < times.size(); ++t) EXPECT_EQ(times[t], static_cast<double>(t));
  }
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
