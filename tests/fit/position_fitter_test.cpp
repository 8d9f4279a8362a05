#include "model/fit/solver/position_fitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "model/core/error.h"
#include "model/fit/solver/fit_clip.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/fit/fit_fixtures.h"
#include "tests/motion/motion_fixtures.h"

namespace choreo::position_fitter_test {

using fixtures::Positions;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

double MeanJointError(const Motion& a, const Motion& b) {
  double sum = 0;
  for (size_t frame = 0; frame < a.frames.size(); ++frame) {
    const Eigen::Matrix3Xd difference =
        JointPositions(Smpl(), a.frames[frame]) - JointPositions(Smpl(), b.frames[frame]);
    sum += difference.colwise().norm().mean();
  }
  return sum / static_cast<double>(a.frames.size());
}

// The largest rotation of a joint between frames. Of rotations, not vectors: near a whole turn
// those move fast.
double LargestStep(const Motion& motion) {
  double largest = 0;
  for (size_t frame = 1; frame < motion.frames.size(); ++frame) {
    for (int joint = 0; joint < Smpl().joints(); ++joint) {
      largest = std::max(largest, RotationDifference(motion.frames[frame - 1].rotations.col(joint),
                                                     motion.frames[frame].rotations.col(joint))
                                      .norm());
    }
  }
  return largest;
}

// The bend of a knee or elbow about its hinge, radians; negative is backwards.
double LeastBend(const Motion& motion) {
  double least = 10;
  for (const Pose& pose : motion.frames) {
    for (const double bend :
         {pose.rotations(0, Smpl().left_knee), pose.rotations(0, Smpl().right_knee),
          -pose.rotations(1, Smpl().left_elbow), pose.rotations(1, Smpl().right_elbow)}) {
      least = std::min(least, bend);
    }
  }
  return least;
}

const FitOptions kAsRecorded = {.ground = false};

class FitRoundTrip : public testing::TestWithParam<int> {};

TEST_P(FitRoundTrip, FindsRotationsThatPutEveryJointWithinAMillimetre) {
  const Motion motion = fixtures::SmoothMotion(Smpl(), GetParam(), 240);
  const FitResult result =
      FitClip(Positions(Smpl(), motion), IdentitySource(Smpl()), Smpl(), kAsRecorded);
  ASSERT_EQ(result.motion.frames.size(), motion.frames.size());
  EXPECT_LT(result.mean_error_m, 0.001);
  EXPECT_NEAR(result.scale, 1, 1e-9);
  EXPECT_LT(MeanJointError(result.motion, motion), 0.001);
  EXPECT_LT(LargestStep(result.motion), 2 * LargestStep(motion));
  EXPECT_GT(LeastBend(result.motion), -0.05);
}

TEST_P(FitRoundTrip, WorksCausallyFrameByFrame) {
  const Motion motion = fixtures::SmoothMotion(Smpl(), GetParam(), 240);
  const SourceMapping mapping = IdentitySource(Smpl());
  PositionFitter fitter(Smpl(), mapping);
  Motion fitted;
  for (const Pose& pose : motion.frames)
    fitted.frames.push_back(fitter.Next(JointPositions(Smpl(), pose)));
  EXPECT_LT(MeanJointError(fitted, motion), 0.001);
  EXPECT_LT(LargestStep(fitted), 2 * LargestStep(motion));
}

INSTANTIATE_TEST_SUITE_P(Seeds, FitRoundTrip, testing::Range(1, 6));

// Steps that do not help are refused; the frame must not be given up, or it repeats the one before.
// With unreachable targets many first steps are refused.
TEST(Fit, NeverRepeatsAFrameThatMoved) {
  FitOptions hasty;
  hasty.iterations = 1;
  PositionFitter fitter(Smpl(), IdentitySource(Smpl()), hasty);
  const Motion motion = fixtures::SmoothMotion(Smpl(), 9, 120);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.1);
  fitter.Reset(motion.frames[0]);
  Pose last = motion.frames[0];
  for (size_t frame = 1; frame < motion.frames.size(); ++frame) {
    const Pose& pose =
        fitter.Next(JointPositions(Smpl(), motion.frames[frame]).unaryExpr([&](double x) {
          return x + noise(random);
        }));
    EXPECT_GT((pose.root_position - last.root_position).norm(), 1e-6) << "frame " << frame;
    last = pose;
  }
}

// An elbow that is bent far and also turned passes half a turn, where its vector flips.
TEST(Fit, FollowsAnElbowPastHalfATurn) {
  const int elbow = Smpl().left_elbow;
  const Eigen::Vector3d hinge(0, -1, 0), side(0, 0, 1);
  const auto folded = [&](int frame) {
    Pose pose = RestPose(Smpl());
    const double u = frame / 30.0;
    pose.rotations.col(elbow) = (2.2 + 0.4 * u) * hinge + (1.2 + 1.0 * u) * side;
    return pose;
  };
  ASSERT_LT(folded(0).rotations.col(elbow).norm(), std::numbers::pi);
  ASSERT_GT(folded(30).rotations.col(elbow).norm(), std::numbers::pi);
  PositionFitter fitter(Smpl(), IdentitySource(Smpl()));
  fitter.Reset(folded(0));
  Pose last = folded(0);
  for (int frame = 1; frame <= 30; ++frame) {
    const Pose& pose = fitter.Next(JointPositions(Smpl(), folded(frame)));
    const double turn =
        RotationDifference(last.rotations.col(elbow), pose.rotations.col(elbow)).norm();
    EXPECT_GT(turn, 1e-4) << frame;
    EXPECT_LT(turn, 0.3) << frame;
    last = pose;
  }
}

TEST(Fit, OpenTurnsFollowTheGivenDirection) {
  const Pose rest = RestPose(Smpl());
  const int wrist = 20, hand = 22;
  const Eigen::Vector3d forearm = Smpl().offsets.col(hand).normalized();
  Pose turned = rest;
  turned.rotations.col(wrist) = 0.6 * forearm;  // moves no joint
  PositionFitter fitter(Smpl(), IdentitySource(Smpl()));
  fitter.Reset(rest);
  const Eigen::Matrix3Xd targets = JointPositions(Smpl(), rest);
  const Pose pose = fitter.Next(targets, &turned);
  EXPECT_NEAR(pose.rotations.col(wrist).dot(forearm), 0.3, 0.05);
  EXPECT_LT((JointPositions(Smpl(), pose) - targets).colwise().norm().maxCoeff(), 0.003);
  fitter.Reset(rest);
  EXPECT_NEAR(fitter.Next(targets).rotations.col(wrist).dot(forearm), 0, 0.01);
}

TEST(Fit, DoesNotDependOnWhereTheSceneStands) {
  const Motion motion = fixtures::SmoothMotion(Smpl(), 7, 30);
  const PositionClip clip = Positions(Smpl(), motion);
  PositionClip moved = clip;
  const Eigen::Matrix3d turn = HeadingRotation(2.0);
  for (Eigen::Matrix3Xd& frame : moved.frames)
    frame = (turn * frame).colwise() + Eigen::Vector3d(3, 0, -5);
  const Motion a = FitClip(clip, IdentitySource(Smpl()), Smpl()).motion;
  const Motion b = FitClip(moved, IdentitySource(Smpl()), Smpl()).motion;
  for (size_t frame = 0; frame < a.frames.size(); ++frame) {
    EXPECT_LT(
        (turn * ExpMap(a.frames[frame].rotations.col(0)) - ExpMap(b.frames[frame].rotations.col(0)))
            .norm(),
        1e-4);
    EXPECT_LT((a.frames[frame].rotations.rightCols(23) - b.frames[frame].rotations.rightCols(23))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-4);
  }
}

TEST(Fit, AcceptsASubjectOfAnotherSize) {
  const Motion motion = fixtures::SmoothMotion(Smpl(), 8, 60);
  PositionClip clip = Positions(Smpl(), motion);
  for (Eigen::Matrix3Xd& frame : clip.frames) frame *= 100;  // centimetres
  const FitResult result = FitClip(clip, IdentitySource(Smpl()), Smpl(), kAsRecorded);
  EXPECT_NEAR(result.scale, 0.01, 1e-9);
  EXPECT_LT(MeanJointError(result.motion, motion), 0.001);
}

TEST(Fit, KneesAndElbowsNeverBendBackwards) {
  // Limbs that straighten, and knees and elbows that the source bends the wrong way by up to 12
  // degrees, as noisy recordings do.
  Motion motion = fixtures::SmoothMotion(Smpl(), 9, 200);
  double wrong = 0;
  for (size_t frame = 0; frame < motion.frames.size(); ++frame) {
    const double bend = 0.4 + 0.6 * std::sin(0.1 * static_cast<double>(frame));
    Pose& pose = motion.frames[frame];
    pose.rotations.col(Smpl().left_knee) = Eigen::Vector3d(bend, 0, 0);
    pose.rotations.col(Smpl().right_knee) = Eigen::Vector3d(1 - bend, 0, 0);
    pose.rotations.col(Smpl().left_elbow) = Eigen::Vector3d(0, -bend, 0);
    pose.rotations.col(Smpl().right_elbow) = Eigen::Vector3d(0, 1 - bend, 0);
    wrong = std::min(wrong, bend);
  }
  ASSERT_LT(wrong, -0.19);
  SourceMapping mapping = IdentitySource(Smpl());
  mapping.accuracy_m = 0.01;
  const FitResult result = FitClip(Positions(Smpl(), motion), mapping, Smpl());
  EXPECT_GT(LeastBend(result.motion), -0.05);
  EXPECT_LT(result.mean_error_m, 0.02);
}

TEST(Fit, StartsFromAnyPose) {
  // Without a frame before, each frame is a first one, and bent limbs must come out right from
  // positions alone.
  const Motion motion = fixtures::SmoothMotion(Smpl(), 10, 300);
  for (size_t frame = 0; frame < motion.frames.size(); frame += 15) {
    PositionFitter fitter(Smpl(), IdentitySource(Smpl()));
    const Eigen::Matrix3Xd positions = JointPositions(Smpl(), motion.frames[frame]);
    const Pose& pose = fitter.Next(positions);
    EXPECT_LT((JointPositions(Smpl(), pose) - positions).colwise().norm().mean(), 0.002) << frame;
  }
}

TEST(Fit, RecoversAfterAJump) {
  const Motion motion = fixtures::SmoothMotion(Smpl(), 11, 300);
  PositionFitter fitter(Smpl(), IdentitySource(Smpl()));
  fitter.Next(JointPositions(Smpl(), motion.frames[0]));
  const Eigen::Matrix3Xd far = JointPositions(Smpl(), motion.frames[299]);
  fitter.Next(far);
  fitter.Next(far);
  EXPECT_LT((JointPositions(Smpl(), fitter.Next(far)) - far).colwise().norm().mean(), 0.003);
}

// Hips and shoulders a whole turn apart are in the same places as without it, so no distance shows
// it.
TEST(Fit, UnwindsATrunk) {
  const Pose rest = RestPose(Smpl());
  Pose wound = rest;
  for (const char* joint : {"spine1", "spine2", "spine3"}) {
    wound.rotations(1, Smpl().Find(joint)) = 2 * std::numbers::pi / 3;
  }
  const Eigen::Matrix3Xd targets = JointPositions(Smpl(), rest);
  PositionFitter fitter(Smpl(), IdentitySource(Smpl()));
  fitter.Reset(wound);
  const Pose& pose = fitter.Next(targets);
  for (const char* joint : {"spine1", "spine2", "spine3"}) {
    EXPECT_LT(pose.rotations.col(Smpl().Find(joint)).norm(), 0.1) << joint;
  }
  EXPECT_LT((JointPositions(Smpl(), pose) - targets).colwise().norm().maxCoeff(), 0.001);
}

}  // namespace choreo::position_fitter_test
