#include "model/metrics/control_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/metrics/repetition.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/support/expect_error.h"

namespace choreo::control_figures_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

JointTrack Standing(size_t frames) { return {frames, JointPositions(Body(), RestPose(Body()))}; }

TEST(ControlFigures, RootRelativeDistanceIsTheNormOverAllJoints) {
  const JointTrack real = Standing(4);
  JointTrack danced = real;
  // Two joints, in half of the frames: 3-4-5.
  for (const size_t frame : {0, 2}) {
    danced[frame].col(Body().Find("head")).x() += 0.3;
    danced[frame].col(Body().Find("left_hand")).z() -= 0.4;
  }
  EXPECT_NEAR(RootRelativeDistance(danced, real), 0.25, 1e-12);
  // The dancer's position does not count.
  for (Eigen::Matrix3Xd& frame : danced) frame.colwise() += Eigen::Vector3d(1, 0, 2);
  EXPECT_NEAR(RootRelativeDistance(danced, real), 0.25, 1e-12);
}

// A hand that swings to and fro while its dancer walks.
JointTrack Swinging(double hz, double metres) {
  JointTrack track = Standing(90);
  for (size_t frame = 0; frame < track.size(); ++frame) {
    const double t = static_cast<double>(frame) / 30;
    track[frame].colwise() += Eigen::Vector3d(t, 0, std::sin(30 * t));
    track[frame].col(Body().Find("left_hand")).y() +=
        metres * std::sin(2 * std::numbers::pi * hz * t);
  }
  return track;
}

TEST(ControlFigures, TremorIsTheShareOfQuickMovement) {
  EXPECT_LT(TremorShare(Swinging(0.5, 0.3), 30), 0.001);
  EXPECT_LT(TremorShare(Swinging(3, 0.1), 30), 0.01);
  EXPECT_GT(TremorShare(Swinging(5, 0.1), 30), 0.99);
  // A fifth as wide and five times as quick is equally fast: half of the energy, less what steps of
  // a thirtieth of a second miss.
  JointTrack both = Swinging(1, 0.1);
  const JointTrack quick = Swinging(5, 0.02);
  const int hand = Body().Find("left_hand"), other = Body().Find("right_hand");
  for (size_t i = 0; i < both.size(); ++i)
    both[i].col(other).y() += quick[i].col(hand).y() - Standing(1)[0].col(hand).y();
  EXPECT_NEAR(TremorShare(both, 30), 0.48, 0.01);
  EXPECT_EQ(TremorShare(Standing(20), 30), 0);
  ExpectError(ErrorCode::kInvalidArgument, "fewer than 9 frames",
              [] { TremorShare(Standing(8), 30); });
}

TEST(ControlFigures, VelocityDeviationIsTheMeanOverPartsAndFrames) {
  const BodyPartWeights weights = WeighBodyParts(Body());
  JointTrack track = Standing(5);
  // The left hand has 4 of its arm's 11 shares: 11 mm a step make a factor of 4 mm a frame.
  for (size_t frame = 0; frame < track.size(); ++frame)
    track[frame].col(Body().Find("left_hand")).y() += 0.011 * static_cast<double>(frame);
  const auto danced = TrackPartSpeeds(weights, track);
  ASSERT_EQ(danced.cols(), 4);
  EXPECT_NEAR(danced(static_cast<int>(BodyPart::kLeftArm), 3), 0.004, 1e-12);
  Eigen::Matrix<double, kBodyParts, Eigen::Dynamic> asked(kBodyParts, 4);
  asked.setZero();
  EXPECT_NEAR(VelocityDeviation(danced, asked), 0.004 / kBodyParts, 1e-12);
  asked = danced;
  asked(2, 1) += 0.01;
  EXPECT_NEAR(VelocityDeviation(danced, asked), 0.01 / 20, 1e-12);
}

TEST(ControlFigures, RootDeviationIsTheMeanDistance) {
  JointTrack danced = Standing(3);
  Eigen::Matrix3Xd asked(3, 3);
  for (int frame = 0; frame < 3; ++frame) asked.col(frame) = danced[0].col(0);
  EXPECT_EQ(RootDeviation(danced, asked), 0);
  asked.col(1) += Eigen::Vector3d(0.03, 0, 0.04);
  asked.col(2).y() -= 0.1;
  EXPECT_NEAR(RootDeviation(danced, asked), 0.05, 1e-12);
}

TEST(ControlFigures, RefuseIncomparableInput) {
  const JointTrack three = Standing(3), four = Standing(4);
  const auto refused = [](const std::string& message, const std::function<void()>& call) {
    ExpectError(ErrorCode::kInvalidArgument, message, call);
  };
  refused("3 frames against 4", [&] { RootRelativeDistance(three, four); });
  refused("3 frames against 4", [&] { RootDeviation(three, Eigen::Matrix3Xd::Zero(3, 4)); });
  refused("0 frames against 0", [] { RootRelativeDistance({}, {}); });
  refused("no step", [&] { TrackPartSpeeds(WeighBodyParts(Body()), Standing(1)); });
}

/// Both arms swing, `turns` times a second at first and `sweep` a second faster each second, while
/// the dancer walks a circle.
std::vector<Pose> Swinging(int frames, double turns, double sweep) {
  std::vector<Pose> poses;
  for (int frame = 0; frame < frames; ++frame) {
    const double time = frame / 30.0;
    const double swing =
        std::sin(2 * std::numbers::pi * (turns * time + 0.5 * sweep * time * time));
    Pose pose = RestPose(Body());
    pose.rotations.col(Body().left_shoulder) = Eigen::Vector3d(0, 0, 0.9 * swing);
    pose.rotations.col(Body().right_shoulder) = Eigen::Vector3d(0.7 * swing, 0, 0.8);
    pose.rotations.col(0) = Eigen::Vector3d(0, 0.5 * time, 0);
    pose.root_position += Eigen::Vector3d(std::sin(0.5 * time), 0, std::cos(0.5 * time));
    poses.push_back(pose);
  }
  return poses;
}

TEST(RepetitionTest, FindsRepetitionAnywhereOnTheFloor) {
  const Repetition repetition = MeasureRepetition(Body(), Swinging(240, 1, 0), 30);
  EXPECT_EQ(repetition.frozen, 0);
  // All but the first second, of 226 windows.
  EXPECT_NEAR(repetition.repeated, 196.0 / 226, 1e-12);
}

TEST(RepetitionTest, FindsNoRepetitionInNewMotion) {
  // One way, slowly.
  std::vector<Pose> poses;
  for (int frame = 0; frame < 150; ++frame) {
    Pose pose = RestPose(Body());
    for (const int joint : {Body().left_shoulder, Body().right_shoulder, Body().left_hip})
      pose.rotations(2, joint) = frame / 100.0;
    poses.push_back(pose);
  }
  const Repetition repetition = MeasureRepetition(Body(), poses, 30);
  EXPECT_EQ(repetition.repeated, 0);
  EXPECT_EQ(repetition.frozen, 0);
}

TEST(RepetitionTest, AnEndingThatFreezesIsFrozenNotRepeated) {
  std::vector<Pose> poses = Swinging(120, 0.3, 0.2);
  poses.resize(180, poses.back());
  const Repetition whole = MeasureRepetition(Body(), poses, 30);
  const Repetition ending = MeasureRepetition(Body(), poses, 30, 120);
  EXPECT_EQ(ending.frozen, 1);
  EXPECT_EQ(ending.repeated, 0);
  EXPECT_GT(whole.frozen, 0.2);
  EXPECT_LT(whole.frozen, 0.4);
}

TEST(RepetitionTest, RefusesShortMotions) {
  ExpectError(ErrorCode::kInvalidArgument, "no window of 15 frames begins at frame 0 of 14",
              [] { MeasureRepetition(Body(), Swinging(14, 1, 0), 30); });
}

}  // namespace choreo::control_figures_test
