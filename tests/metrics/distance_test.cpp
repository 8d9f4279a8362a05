#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/metrics/groove.h"
#include "model/metrics/joint_track.h"
#include "model/metrics/pose_distance.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"

namespace choreo::distance_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

std::vector<Pose> Standing(int frames) {
  return std::vector<Pose>(static_cast<size_t>(frames), RestPose(Body()));
}

TEST(PoseDistance, L2PIsTheMeanJointDistance) {
  const std::vector<Pose> real = Standing(4);
  std::vector<Pose> moved = real;
  for (Pose& pose : moved) pose.root_position += Eigen::Vector3d(0.3, 0, 0.4);
  EXPECT_NEAR(L2P(TrackJoints(Body(), moved), TrackJoints(Body(), real)), 0.5, 1e-12);
  moved[0] = moved[1] = real[0];
  EXPECT_NEAR(L2P(TrackJoints(Body(), moved), TrackJoints(Body(), real)), 0.25, 1e-12);
  ExpectError(ErrorCode::kInvalidArgument, "danced: 4 frames against 3",
              [&] { L2P(TrackJoints(Body(), moved), TrackJoints(Body(), Standing(3))); });
}

TEST(PoseDistance, KeyPoseDistanceIsSquared) {
  const Eigen::Matrix3Xd real = JointPositions(Body(), RestPose(Body()));
  const Eigen::Matrix3Xd moved = real.colwise() + Eigen::Vector3d(0.3, 0, 0.4);
  EXPECT_NEAR(KeyPoseDistance(moved, real), 0.25, 1e-12);
}

TEST(PoseDistance, L2QOfATurnAndOfWholeTurns) {
  const std::vector<Pose> real = Standing(3);
  std::vector<Pose> turned = real;
  // A turn of the root turns all joints: |q - 1| = 2 sin(angle / 4) each.
  for (Pose& pose : turned) pose.rotations.col(0) = Eigen::Vector3d(0, 1, 0);
  const double expected = 2 * std::sin(0.25) * std::sqrt(Body().joints());
  const Eigen::MatrixXd a = GlobalQuaternions(Body(), turned), b = GlobalQuaternions(Body(), real);
  EXPECT_NEAR(L2Q(a, b), expected, 1e-9);
  for (Pose& pose : turned) pose.rotations.col(0) = Eigen::Vector3d(0, 1 + 2 * M_PI, 0);
  EXPECT_NEAR(L2Q(GlobalQuaternions(Body(), turned), b), expected, 1e-9);
  EXPECT_NEAR(L2Q(-a, b), expected, 1e-9);
}

Eigen::MatrixXd Wave(int cycles, int frames, double height) {
  Eigen::MatrixXd wave(1, frames);
  for (int t = 0; t < frames; ++t) wave(0, t) = height * std::cos(2 * M_PI * cycles * t / frames);
  return wave;
}

TEST(Npss, IsTheEarthMoversDistanceOfPower) {
  constexpr int kFrames = 40;
  const auto value = [](const Eigen::MatrixXd& danced, const Eigen::MatrixXd& real) {
    const Npss npss = MeasureNpss(danced, real);
    return npss.sum / npss.weight;
  };
  // Height does not matter.
  EXPECT_NEAR(value(Wave(3, kFrames, 0.1), Wave(3, kFrames, 2)), 0, 1e-9);
  // Half the power sits at each of k and frames - k: from 3 to 5 both halves move by 2 bins.
  EXPECT_NEAR(value(Wave(5, kFrames, 1), Wave(3, kFrames, 1)), 2, 1e-9);
  // Weighted by the real power: 4 to 1.
  Eigen::MatrixXd danced(2, kFrames), real(2, kFrames);
  danced << Wave(5, kFrames, 1), Wave(3, kFrames, 1);
  real << Wave(3, kFrames, 2), Wave(3, kFrames, 1);
  EXPECT_NEAR(value(danced, real), 0.8 * 2, 1e-9);
  EXPECT_EQ(MeasureNpss(Eigen::MatrixXd::Zero(1, 8), Eigen::MatrixXd::Zero(1, 8)).weight, 0);
}

// The root hops by `up` metres at frame 2; the feet go by `left` and `right` metres a frame.
JointTrack Hop(double up, const Eigen::Vector3d& left, const Eigen::Vector3d& right) {
  JointTrack track;
  for (int t = 0; t < 5; ++t) {
    Eigen::Matrix3Xd joints = JointPositions(Body(), RestPose(Body()));
    if (t == 2) joints(1, 0) += up;
    for (int foot : {0, 1}) joints.col(Body().feet[foot]) += t * left;
    for (int foot : {2, 3}) joints.col(Body().feet[foot]) += t * right;
    track.push_back(joints);
  }
  return track;
}

TEST(PhysicalFootContact, NeedsBothFeetToSlideWhileTheBodyAccelerates) {
  // Accelerations of +up, -2 up (its downward part does not count), +up over three frames.
  const Eigen::Vector3d left(0.02, 0, 0), right(0, 0, 0.03), nowhere(0, 0, 0);
  EXPECT_NEAR(PhysicalFootContact(Body(), Hop(0.1, left, right)), 1e4 * 2 * 0.0006 / 3, 1e-9);
  EXPECT_EQ(PhysicalFootContact(Body(), Hop(0.1, nowhere, right)), 0);
  EXPECT_EQ(PhysicalFootContact(Body(), Hop(0, left, right)), 0);
}

TEST(PhysicalFootContact, CountsHorizontalFootMotionAlone) {
  // A jump lifts both feet without sliding.
  const Eigen::Vector3d up(0, 0.05, 0), right(0, 0, 0.03);
  EXPECT_EQ(PhysicalFootContact(Body(), Hop(0.1, up, up)), 0);
  EXPECT_EQ(PhysicalFootContact(Body(), Hop(0.1, up, right)), 0);
  // Of 13 cm that rise by 12, it counts the 5 over the floor, 3 and 4 along its axes.
  const Eigen::Vector3d diagonal(0.03, 0.12, 0.04);
  EXPECT_NEAR(PhysicalFootContact(Body(), Hop(0.1, diagonal, right)), 1e4 * 2 * 0.05 * 0.03 / 3,
              1e-9);
}

TEST(Pace, MedianSpeedAndJerkOfACubicPath) {
  JointTrack track;
  for (int t = 0; t < 6; ++t) {
    Eigen::Matrix3Xd joints = Eigen::Matrix3Xd::Zero(3, 1);
    joints(0, 0) = std::pow(t / 30.0, 3);  // third derivative 6
    track.push_back(joints);
  }
  Pace pace;
  pace.Add(track, 30);
  EXPECT_EQ(pace.jerks.size(), 3U);
  EXPECT_NEAR(pace.median_jerk(), 6, 1e-4);
  EXPECT_NEAR(pace.median_speed(), 30 * (27 - 8) / 27000.0, 1e-6);  // the third of five steps
}

TEST(Pace, PercentilesAreRanks) {
  EXPECT_EQ(Percentile({}, 0.5), 0);
  EXPECT_EQ(Percentile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(Percentile({4, 3, 1, 2}, 0.95), 4);
  EXPECT_EQ(Percentile({4, 3, 1, 2}, 0), 1);
}

}  // namespace choreo::distance_test
