#include "model/motion/kinematics/joint_angles.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/motion/kinematics/kinematics.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/expect_error.h"

namespace choreo::joint_angles_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// Position of a joint relative to another that is turned by these degrees.
Eigen::Vector3d Seen(const std::string& turned, const std::vector<double>& degrees,
                     const std::string& end) {
  Pose pose = RestPose(Body());
  const int joint = Body().Find(turned);
  pose.rotations.col(joint) = RotationFromDegrees(Body(), joint, degrees, "test");
  const Eigen::Matrix3Xd places = JointPositions(Body(), pose);
  return places.col(Body().Find(end)) - places.col(joint);
}

TEST(JointAngles, TurnLimbsTheWayThatTheyAreDescribed) {
  EXPECT_GT(Seen("left_elbow", {90}, "left_wrist").z(), 0.26);
  EXPECT_GT(Seen("right_elbow", {90}, "right_wrist").z(), 0.26);
  EXPECT_LT(Seen("left_knee", {90}, "left_ankle").z(), -0.4);
  EXPECT_GT(Seen("left_shoulder", {0, 0, 90}, "left_elbow").y(), 0.25);
  EXPECT_GT(Seen("left_shoulder", {0, -90, 0}, "left_elbow").z(), 0.25);
  EXPECT_LT(Seen("right_shoulder", {0, 0, 90}, "right_elbow").y(), -0.25);
  EXPECT_GT(Seen("left_hip", {-90, 0, 0}, "left_knee").z(), 0.38);
  EXPECT_GT(Seen("left_hip", {0, 0, 90}, "left_knee").x(), 0.38);
  EXPECT_GT(Seen("spine1", {30, 0, 0}, "head").z(), 0.15);
  EXPECT_GT(Seen("neck", {0, 80, 0}, "head").x(), 0.04);
}

// About x first: an arm that is twisted and then lowered ends at the side, not in front.
TEST(JointAngles, TurnAboutXThenYThenZ) {
  const Eigen::Vector3d hand = Seen("left_shoulder", {70, 0, -90}, "left_elbow");
  EXPECT_LT(hand.y(), -0.25);
  EXPECT_NEAR(hand.z(), Seen("left_shoulder", {70, 0, 0}, "left_elbow").z(), 1e-12);
}

TEST(JointAngles, RoundTrip) {
  for (int joint = 0; joint < Body().joints(); ++joint) {
    const std::vector<double> degrees =
        std::ranges::any_of(Hinges(Body()),
                            [&](const Hinge& hinge) { return hinge.joint == joint; })
            ? std::vector{77.0}
            : std::vector{-20.0, 35.0, 51.0};
    const Eigen::Vector3d rotation = RotationFromDegrees(Body(), joint, degrees, "test");
    const std::vector<double> back = DegreesFromRotation(Body(), joint, rotation);
    ASSERT_EQ(back.size(), degrees.size());
    for (size_t i = 0; i < back.size(); ++i) EXPECT_NEAR(back[i], degrees[i], 1e-9) << joint;
  }
  // Where x and z turn about the same axis, several answers are right.
  const int hip = Body().left_hip;
  const Eigen::Vector3d locked =
      RotationFromDegrees(Body(), hip, std::vector{20.0, 90.0, 50.0}, "test");
  const Eigen::Vector3d again =
      RotationFromDegrees(Body(), hip, DegreesFromRotation(Body(), hip, locked), "test");
  EXPECT_LT((again - locked).norm(), 1e-6);
}

TEST(JointAngles, ErrorsNameJointValueAndRange) {
  const auto refused = [](const std::string& name, const std::vector<double>& degrees,
                          const std::string& part) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] {
      RotationFromDegrees(Body(), RequireJoint(Body(), name, "--set"), degrees, "--set");
    });
  };
  refused("left_elbow", {200}, "--set: left_elbow is at 200 degrees, must be 0 to 165");
  refused("right_knee", {-5}, "right_knee is at -5 degrees, must be 0 to 165");
  refused("neck", {0, 0, 95}, "neck is at 95 degrees about z, must be -80 to 80");
  refused("left_elbow", {1, 2, 3}, "left_elbow takes one number, the degrees of its bend");
  refused("neck", {1}, "neck takes three numbers, degrees about x, y and z; there are 1");
  refused("elbow", {1}, "--set: \"elbow\" is not a joint of smpl24, which has pelvis, left_hip");
}

}  // namespace choreo::joint_angles_test
