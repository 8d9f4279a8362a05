#include "model/dance/foot_lock.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "model/dance/quality_report.h"
#include "model/motion/kinematics.h"
#include "model/motion/resample.h"

namespace choreo::foot_lock_test {

constexpr double kFps = 30;

const Skeleton& Body() { return Skeleton::Smpl24(); }

// Standing with soft knees, `x` metres to the side.
Pose At(double x) {
  Pose pose = RestPose(Body());
  for (const Leg& leg : Leg::Of(Body())) {
    pose.rotations.col(leg.hip).x() = -0.25;
    pose.rotations.col(leg.knee).x() = 0.5;
    pose.rotations.col(leg.ankle).x() = -0.25;
  }
  pose.root_position += Eigen::Vector3d(x, -0.025, 0);
  return pose;
}

std::vector<Pose> Standing() { return std::vector<Pose>(10, At(0)); }

// A model that glides over the floor, both feet down, with `speed` m/s.
Motion Dance(int frames, double speed, const std::optional<Target>& target) {
  FootLock lock(Body(), kFps, frames, Standing(), target);
  Motion motion{.fps = kFps, .frames = {At(0)}};
  for (int t = 0; t < frames; ++t) {
    motion.frames.push_back(lock.Apply(At(speed * (t + 1) / kFps)));
  }
  return motion;
}

TEST(FootLock, AGlidingBodySteps) {
  const int frames = 90;
  const double speed = 0.4;
  const Target key{At(speed * frames / kFps), {}};
  Motion glide{.fps = kFps, .frames = {At(0)}};
  for (int t = 1; t <= frames; ++t) glide.frames.push_back(At(speed * t / kFps));
  EXPECT_GT(MeasureMotion(Body(), glide).skate_ratio, 0.9);

  const Motion dance = Dance(frames, speed, key);
  const QualityReport report = MeasureMotion(Body(), dance);
  EXPECT_LT(report.skate_ratio, 0.13);
  EXPECT_LT(report.max_acceleration, 65);  // real dances' 95th percentile
  // Everything but the legs is the model's.
  for (size_t t = 0; t < dance.frames.size(); ++t) {
    EXPECT_EQ(dance.frames[t].root_position, glide.frames[t].root_position);
    EXPECT_EQ(dance.frames[t].rotations.rightCols(12), glide.frames[t].rotations.rightCols(12));
  }
}

TEST(FootLock, OneFootCarriesTheOther) {
  const int frames = 90;
  FootLock lock(Body(), kFps, frames, Standing(), std::nullopt);
  int steps = 0;
  bool was_up = false;
  for (int t = 0; t < frames; ++t) {
    lock.Apply(At(0.25 * (t + 1) / kFps));
    const bool up = lock.contacts()[1] == 0 || lock.contacts()[3] == 0;
    EXPECT_TRUE(lock.contacts()[1] == 1 || lock.contacts()[3] == 1) << "frame " << t;
    steps += up && !was_up ? 1 : 0;
    was_up = up;
  }
  EXPECT_GE(steps, 3);  // 75 cm
}

TEST(FootLock, TheKeyIsUntouchedAndItsFeetStandBeforeIt) {
  for (const int frames : {10, 14, 30, 60}) {
    const Target key{At(0.3), {}};
    const Motion dance = Dance(frames, 0.3 * kFps / frames, key);
    EXPECT_EQ(dance.frames.back().rotations, key.pose.rotations);
    const Eigen::Matrix3Xd end = JointPositions(Body(), dance.frames.back());
    const Eigen::Matrix3Xd before = JointPositions(Body(), dance.frames[dance.frames.size() - 2]);
    for (const Leg& leg : Leg::Of(Body())) {
      EXPECT_LT((end.col(leg.toes) - before.col(leg.toes)).norm(), 0.01) << frames;
    }
  }
}

// A landing jolts: what is planned lands a tenth of a second ahead where there is time.
TEST(FootLock, FeetStandWellBeforeTheKeyWhereThereIsTime) {
  const Target key{At(0.3), {}};
  for (const auto& [frames, standing] : {std::pair{60, 4}, {30, 4}, {23, 3}}) {
    const Motion dance = Dance(frames, 0.3 * kFps / frames, key);
    const Eigen::Matrix3Xd end = JointPositions(Body(), key.pose);
    const auto away = [&](size_t back) {
      const Eigen::Matrix3Xd now =
          JointPositions(Body(), dance.frames[dance.frames.size() - 1 - back]);
      double farthest = 0;
      for (const Leg& leg : Leg::Of(Body()))
        farthest = std::max(farthest, (now.col(leg.toes) - end.col(leg.toes)).norm());
      return farthest;
    };
    for (size_t back = 0; back < static_cast<size_t>(standing); ++back)
      EXPECT_LT(away(back), 0.005) << back << " frames before the key of " << frames;
  }
}

// A third of a second: both feet step, one after the other, low enough not to be thrown.
TEST(FootLock, BetweenKeysThatStandCloseStepsAreQuickAndLow) {
  const Target key{At(0.15), {}};
  const Motion dance = Dance(10, 0.15 * kFps / 10, key);
  const std::array<Leg, 2> legs = Leg::Of(Body());
  double highest = 0;
  for (size_t t = 1; t < dance.frames.size(); ++t) {
    const Eigen::Matrix3Xd before = JointPositions(Body(), dance.frames[t - 1]);
    const Eigen::Matrix3Xd now = JointPositions(Body(), dance.frames[t]);
    const auto step = [&](size_t side) {
      return (now.col(legs[side].toes) - before.col(legs[side].toes)).norm();
    };
    EXPECT_LT(std::min(step(0), step(1)), 0.003) << "no foot stands in frame " << t;
    for (const Leg& leg : legs) highest = std::max(highest, now(1, leg.toes));
  }
  const double stands = JointPositions(Body(), At(0))(1, legs[0].toes);
  EXPECT_GT(highest, stands + 0.015);
  EXPECT_LT(highest, stands + 0.04);
}

TEST(FootLock, WhoStandsIsNotTouched) {
  const Target key{At(0), {}};
  const Motion dance = Dance(40, 0, key);
  for (const Pose& pose : dance.frames) {
    EXPECT_LT(ComparePoses(Body(), pose, At(0)).position_m, 0.03);
  }
  EXPECT_EQ(MeasureMotion(Body(), dance).skate_ratio, 0);
}

// Degrees between thigh and shin; 0: in line.
double Flexion(const Leg& leg, const Pose& pose) {
  const Eigen::Matrix3Xd joints = JointPositions(Body(), pose);
  const Eigen::Vector3d thigh = joints.col(leg.knee) - joints.col(leg.hip);
  const Eigen::Vector3d shin = joints.col(leg.ankle) - joints.col(leg.knee);
  return std::atan2(thigh.cross(shin).norm(), thigh.dot(shin)) * 180 / M_PI;
}

// Knees that snap into their full length, or out of it, are what shows most of a lock: eight
// degrees in a frame from or to less than five, which no dancer does.
TEST(FootLock, NoKneeSnapsThatWasStraight) {
  const int frames = 150;
  for (const double beyond : {0.0, 0.06, 0.11}) {  // radians; the last is as straight as legs get
    Pose straight = RestPose(Body());
    for (const Leg& leg : Leg::Of(Body())) straight.rotations(0, leg.knee) = -beyond;
    for (const double glide : {0.0, 0.2, 0.4}) {
      FootLock lock(Body(), kFps, frames, std::vector<Pose>(10, straight), std::nullopt);
      Pose last = straight;
      for (int t = 1; t <= frames; ++t) {
        Pose model = straight;
        model.root_position +=
            Eigen::Vector3d(glide * t / kFps, 0.03 * std::sin(2 * M_PI * t / kFps), 0);
        const Pose now = lock.Apply(model);
        for (const Leg& leg : Leg::Of(Body())) {
          const double from = Flexion(leg, last), to = Flexion(leg, now);
          EXPECT_FALSE(std::min(from, to) < 5 && std::abs(to - from) > 8)
              << beyond << ' ' << glide << " frame " << t << ": " << from << " to " << to;
          EXPECT_GT(now.rotations(0, leg.knee), -beyond - 0.05);
        }
        last = now;
      }
    }
  }
}

// The body comes late, in the last third of a second: feet wait for it in the air.
TEST(FootLock, AStepReachesNoFartherThanTheLeg) {
  const int frames = 60, late = 50;
  for (const double way : {0.4, 0.7, 0.9}) {
    FootLock lock(Body(), kFps, frames, Standing(), Target{At(way), {}});
    const double soft = Flexion(Leg::Of(Body())[0], At(0));
    for (int t = 0; t < frames; ++t) {
      const double there = std::max(0.0, (t + 1.0 - late) / (frames - late));
      const Pose now = lock.Apply(At(way * there * there * (3 - 2 * there)));
      if (t + 1 == late) {
        EXPECT_FALSE(lock.contacts()[1] == 1 && lock.contacts()[3] == 1);
      }
      for (const Leg& leg : Leg::Of(Body())) {
        EXPECT_GT(Flexion(leg, now), std::min(soft, 12.0)) << way << " m, frame " << t;
      }
    }
    EXPECT_EQ(lock.contacts(), Contacts({1, 1, 1, 1})) << way;
  }
}

TEST(FootLock, AFootThatTheModelLiftsIsTheModels) {
  const int frames = 60;
  Pose lifted = At(0);
  const Leg left = Leg::Of(Body())[0];
  lifted.rotations.col(left.hip).x() = -1.4;
  lifted.rotations.col(left.knee).x() = 1.0;
  FootLock lock(Body(), kFps, frames, Standing(), std::nullopt);
  Pose emitted;
  for (int t = 0; t < frames; ++t) {
    emitted = lock.Apply(InterpolatePoses(At(0), lifted, std::min(1.0, t / 20.0)));
  }
  const Eigen::Matrix3Xd ours = JointPositions(Body(), emitted);
  const Eigen::Matrix3Xd models = JointPositions(Body(), lifted);
  EXPECT_LT((ours.col(left.toes) - models.col(left.toes)).norm(), 1e-6);
  EXPECT_EQ(lock.contacts()[1], 0);
  EXPECT_EQ(lock.contacts()[3], 1);
}

// A foot that the model has in the air leaves the floor as soon as any other.
TEST(FootLock, AStepIsNoLowerWhereTheModelLiftsTheFoot) {
  const Leg left = Leg::Of(Body())[0];
  const double standing = JointPositions(Body(), At(0))(1, left.toes);
  FootLock lock(Body(), kFps, 90, Standing(), std::nullopt);
  Pose model, emitted;
  for (int t = 0; t < 3; ++t) {  // a third of a step
    model = At(0.06 * (t + 1));
    model.rotations.col(left.hip).x() -= 0.5;
    model.rotations.col(left.knee).x() += 0.5;
    emitted = lock.Apply(model);
  }
  EXPECT_GT(JointPositions(Body(), model)(1, left.toes) - standing, 0.08);
  EXPECT_GT(JointPositions(Body(), emitted)(1, left.toes) - standing, 0.035);
}

TEST(FootLock, ToesStayAboveTheFloor) {
  FootLock lock(Body(), kFps, 60, Standing(), std::nullopt);
  double lowest = 1;
  for (int t = 0; t < 60; ++t) {
    Pose sunk = At(0.01 * t);
    sunk.root_position.y() -= 0.08;
    const Eigen::Matrix3Xd now = JointPositions(Body(), lock.Apply(sunk));
    for (const Leg& leg : Leg::Of(Body())) lowest = std::min(lowest, now(1, leg.toes));
  }
  EXPECT_GT(lowest, 0);
}

TEST(FootLock, NeedsLegsAndTimeToStep) {
  EXPECT_TRUE(FootLock::Fits(Body(), kFps, 30));
  EXPECT_FALSE(FootLock::Fits(Body(), kFps, 8));
  Skeleton legless = Body();
  legless.left_knee = -1;
  EXPECT_FALSE(FootLock::Fits(legless, kFps, 30));
}

}  // namespace choreo::foot_lock_test
