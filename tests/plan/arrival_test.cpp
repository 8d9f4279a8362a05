#include "model/plan/arrival.h"

#include <gtest/gtest.h>

#include <random>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/dance/poses.h"

namespace choreo::arrival_test {

constexpr double kFps = 30;
constexpr int kWindow = 12;

/// A stand-in for a model: continues from the last pose with a damped, shaken velocity towards a
/// goal that misses the key.
class Wanderer {
 public:
  Wanderer(const Pose& goal, double noise, uint32_t seed)
      : goal_(goal), noise_(noise), random_(seed) {}

  Pose Next(const Pose& previous, int left) {
    std::normal_distribution<double> normal;
    Pose next = previous;
    const double pull = 1.0 / std::max(left, 1);
    next.root_position += pull * (goal_.root_position - previous.root_position);
    for (int axis = 0; axis < 3; ++axis) next.root_position[axis] += noise_ * normal(random_);
    for (int joint = 0; joint < next.rotations.cols(); ++joint) {
      Eigen::Vector3d step =
          pull * RotationDifference(previous.rotations.col(joint), goal_.rotations.col(joint));
      for (double& value : step) value += noise_ * normal(random_);
      next.rotations.col(joint) = RotationCompose(previous.rotations.col(joint), step);
    }
    return next;
  }

 private:
  Pose goal_;
  double noise_;
  std::mt19937 random_;
};

std::vector<Pose> Walk(const std::vector<Pose>& before, const Target& target, int frames,
                       Wanderer& model, int window = kWindow,
                       std::optional<Pose> after = std::nullopt) {
  Arrival arrival(window, frames, target, before, after);
  std::vector<Pose> poses = before;
  for (int frame = 0; frame < frames; ++frame) {
    poses.push_back(arrival.Apply(model.Next(poses.back(), frames - frame)));
  }
  return poses;
}

// Largest joint acceleration at poses[at], m/s^2.
double Acceleration(const std::vector<Pose>& poses, size_t at) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  const Eigen::Matrix3Xd bend = JointPositions(skeleton, poses[at + 1]) -
                                2 * JointPositions(skeleton, poses[at]) +
                                JointPositions(skeleton, poses[at - 1]);
  return bend.colwise().norm().maxCoeff() * kFps * kFps;
}

TEST(Arrival, HitsEveryKeyFromAnywhere) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const int frames = 1 + static_cast<int>(random() % 60);
    const std::vector<Pose> before = MotionTo(RandomPose(random), 2, random);
    const Target target{RandomPose(random), {}};
    Wanderer model(RandomPose(random), 0.02, random());
    const std::vector<Pose> poses = Walk(before, target, frames, model);
    const PoseError error = ComparePoses(Skeleton::Smpl24(), poses.back(), target.pose);
    EXPECT_LT(error.position_m, 1e-6);
    EXPECT_LT(error.angle_deg, 1e-5);
  }
}

// Steers a shaken model to the target, and calls `check(raw, steered)` for each frame. Returns the
// last one.
template <typename Check>
Pose Steer(const Target& target, int frames, std::mt19937& random, const Check& check) {
  const std::vector<Pose> before = MotionTo(RandomPose(random), 2, random);
  Wanderer model(RandomPose(random), 0.02, random());
  Arrival arrival(kWindow, frames, target, before);
  Pose previous = before.back();
  for (int frame = 0; frame < frames; ++frame) {
    const Pose raw = model.Next(previous, frames - frame);
    previous = arrival.Apply(raw);
    check(raw, previous);
  }
  return previous;
}

TEST(Arrival, LeavesMaskedCoordinatesUntouched) {
  std::mt19937 random(2);
  for (int round = 0; round < 50; ++round) {
    Target target{RandomPose(random), {}};
    target.mask.root_position = round % 2 == 0;
    target.mask.joints.resize(24);
    for (size_t joint = 0; joint < 24; ++joint) target.mask.joints[joint] = random() % 2 == 0;
    const Pose last = Steer(target, 20, random, [&](const Pose& raw, const Pose& steered) {
      if (!target.mask.root_position) {
        EXPECT_EQ(steered.root_position, raw.root_position);
      }
      for (int joint = 0; joint < 24; ++joint) {
        if (target.mask.joints[static_cast<size_t>(joint)]) continue;
        EXPECT_EQ(steered.rotations.col(joint), raw.rotations.col(joint));
      }
    });
    const PoseError error = ComparePoses(Skeleton::Smpl24(), last, target.pose, target.mask);
    EXPECT_LT(error.position_m, 1e-6);
    EXPECT_LT(error.angle_deg, 1e-5);
  }
}

TEST(Arrival, MeetsTheHeightOfAKeyThatLeavesItsPlaceOpen) {
  std::mt19937 random(8);
  for (int round = 0; round < 20; ++round) {
    Target target{RandomPose(random), {}, 0.7};
    target.mask.root_position = false;
    const Pose last = Steer(target, 30, random, [](const Pose& raw, const Pose& steered) {
      EXPECT_EQ(steered.root_position.x(), raw.root_position.x());
      EXPECT_EQ(steered.root_position.z(), raw.root_position.z());
    });
    EXPECT_EQ(last.root_position.y(), 0.7);
  }
}

TEST(Arrival, TouchesNothingBeforeItsWindowAndNothingWhenOff) {
  std::mt19937 random(3);
  const std::vector<Pose> before = MotionTo(RandomPose(random), 2, random);
  const Target target{RandomPose(random), {}};
  Wanderer model(RandomPose(random), 0.02, 5);
  Arrival on(kWindow, 40, target, before);
  Arrival off(0, 40, target, before);
  Pose previous = before.back();
  for (int frame = 0; frame < 40; ++frame) {
    const Pose raw = model.Next(previous, 40 - frame);
    EXPECT_TRUE(SameBits(off.Apply(raw), raw));
    const Pose emitted = on.Apply(raw);
    EXPECT_EQ(SameBits(emitted, raw), frame < 28) << frame;
    previous = raw;
  }
}

// A model that already moves evenly onto the key is left alone: the loop adds nothing of its own.
TEST(Arrival, AddsNothingToASteadyApproach) {
  std::mt19937 random(4);
  const std::vector<Pose> way = MotionTo(RandomPose(random), 42, random, 0.02);
  Arrival arrival(kWindow, 40, {way.back(), {}}, {way[0], way[1]});
  for (size_t i = 2; i < way.size(); ++i) {
    EXPECT_LT(ComparePoses(Skeleton::Smpl24(), arrival.Apply(way[i]), way[i]).position_m, 1e-9);
  }
}

TEST(Arrival, MeetsTheMotionThatFollows) {
  std::mt19937 random(5);
  double worst = 0, worst_unaware = 0;
  for (int round = 0; round < 50; ++round) {
    const int frames = 6 + static_cast<int>(random() % 50);
    const std::vector<Pose> before = MotionTo(RandomPose(random), 2, random);
    const std::vector<Pose> key_and_after = MotionTo(RandomPose(random), 2, random, 0.02);
    const Target target{key_and_after[0], {}};
    const Pose goal = RandomPose(random);
    const uint32_t seed = random();
    Wanderer model(goal, 0.005, seed);
    const std::vector<Pose> poses = Walk(before, target, frames, model, kWindow, key_and_after[1]);
    EXPECT_LT(ComparePoses(Skeleton::Smpl24(), poses.back(), target.pose).position_m, 1e-6);
    // The last step is nearly the one that follows.
    const size_t n = poses.size();
    const Eigen::Vector3d last = poses[n - 1].root_position - poses[n - 2].root_position;
    const Eigen::Vector3d next = key_and_after[1].root_position - key_and_after[0].root_position;
    worst = std::max(worst, (last - next).norm());
    Wanderer same(goal, 0.005, seed);
    const std::vector<Pose> unaware = Walk(before, target, frames, same);
    const Eigen::Vector3d free = unaware[n - 1].root_position - unaware[n - 2].root_position;
    worst_unaware = std::max(worst_unaware, (free - next).norm());
  }
  EXPECT_LT(worst, 0.2 * worst_unaware);
}

// A body that had no place to be in glided on after its pose had come to rest.
TEST(Arrival, ARootWithoutAPlaceTakesTheVelocityThatFollows) {
  std::mt19937 random(9);
  const std::vector<Pose> before = MotionTo(RandomPose(random), 10, random, 0.02);
  Target target{RandomPose(random), {}};
  target.mask.root_position = false;
  Pose goal = target.pose;
  goal.root_position = before.back().root_position + Eigen::Vector3d(3, 0, 1);
  for (const double speed : {0.0, 0.02}) {
    Pose after = target.pose;
    after.root_position.x() += speed;
    Wanderer model(goal, 0, 1);
    const std::vector<Pose> poses = Walk(before, target, 30, model, kWindow, after);
    const Eigen::Vector3d last = poses.back().root_position - poses[poses.size() - 2].root_position;
    EXPECT_LT((last - Eigen::Vector3d(speed, 0, 0)).norm(), 1e-9);
    EXPECT_GT(poses.back().root_position.x(), before.back().root_position.x() + 1);
  }
}

// No spike: around the key the acceleration is of the size that the way there needs anyhow, for a
// model that misses by a lot.
TEST(Arrival, HasNoAccelerationSpike) {
  std::mt19937 random(6);
  double worst_ratio = 0;
  for (int round = 0; round < 100; ++round) {
    const int frames = 24 + static_cast<int>(random() % 40);
    const Pose start = RandomPose(random, 0.4);
    const std::vector<Pose> before = MotionTo(start, 2, random);
    Target target{RandomPose(random, 0.4, 0.3), {}};
    Pose goal = target.pose;  // 15 cm and a few degrees beside the key
    goal.root_position += 0.15 * Eigen::Vector3d(1, 0, 1).normalized();
    for (double& value : goal.rotations.reshaped()) value += 0.05;
    Wanderer model(goal, 0, random());
    std::vector<Pose> poses = Walk(before, target, frames, model);
    Wanderer free(goal, 0, random());
    const std::vector<Pose> raw = Walk(before, target, frames, free, /*window=*/0);
    // After the key the motion continues: two frames at the velocity of the arrival.
    const Pose& last = poses.back();
    const Pose& earlier = poses[poses.size() - 2];
    Pose next = last;
    next.root_position += last.root_position - earlier.root_position;
    for (int joint = 0; joint < 24; ++joint) {
      next.rotations.col(joint) = RotationCompose(
          last.rotations.col(joint),
          RotationDifference(earlier.rotations.col(joint), last.rotations.col(joint)));
    }
    poses.push_back(next);
    double at_key = 0;
    for (size_t at = poses.size() - 14; at + 1 < poses.size(); ++at) {
      at_key = std::max(at_key, Acceleration(poses, at));
    }
    // What a parabola over the window needs for the model's miss, both signs: 4 d / T^2.
    const double miss = ComparePoses(Skeleton::Smpl24(), raw.back(), target.pose).position_m;
    const double needed = 4 * miss / (12 / kFps * 12 / kFps);
    worst_ratio = std::max(worst_ratio, at_key / (needed + 5));
  }
  EXPECT_LT(worst_ratio, 4);  // a jump in the last frame would come to 30
}

}  // namespace choreo::arrival_test
