#include "model/body/doll.h"

#include <gtest/gtest.h>

#include "tests/motion/motion_fixtures.h"
#include "tests/support/native_tang2018.h"

namespace choreo::doll_test {

const Skeleton& kSmpl = Skeleton::Smpl24();

TEST(Doll, EveryLeftLimbHasARightOneOfItsSize) {
  const Skeleton skeleton = fixtures::SymmetricSmpl();
  const Eigen::Vector3f mirror(-1, 1, 1);
  int left = 0, right = 0;
  const std::vector<PlacedPart> parts = BuildDoll(skeleton, RestPose(skeleton));
  for (const PlacedPart& part : parts) {
    right += part.colour == kRightColour;
    if (!(part.colour == kLeftColour)) continue;
    ++left;
    EXPECT_GT(part.shape.a.x(), 0);
    EXPECT_TRUE(std::any_of(parts.begin(), parts.end(), [&](const PlacedPart& other) {
      return other.colour == kRightColour && other.shape.radius_a == part.shape.radius_a &&
             (other.shape.a.cwiseProduct(mirror) - part.shape.a).norm() < 1e-6 &&
             (other.shape.b.cwiseProduct(mirror) - part.shape.b).norm() < 1e-6;
    }));
  }
  EXPECT_GE(left, 8);
  EXPECT_EQ(left, right);
}

TEST(Doll, StandsOnTheFloorAtRest) {
  float lowest = 1, highest = 0;
  for (const PlacedPart& part : BuildDoll(kSmpl, RestPose(kSmpl))) {
    lowest = std::min(
        {lowest, part.shape.a.y() - part.shape.radius_a, part.shape.b.y() - part.shape.radius_b});
    highest = std::max(
        {highest, part.shape.a.y() + part.shape.radius_a, part.shape.b.y() + part.shape.radius_b});
  }
  EXPECT_NEAR(lowest, 0, 0.015);
  EXPECT_NEAR(highest, 1.8, 0.05);  // with the bun
}

TEST(Doll, ABodyThatIsNotSmplsHasATrunkAndAHead) {
  const Skeleton& native = testing_support::Native().skeleton;
  const std::vector<PlacedPart> parts = BuildDoll(native, RestPose(native));
  // A capsule a bone, one across the hips, one across the shoulders, and the head.
  EXPECT_GT(std::ssize(parts), native.joints() - 1 + 2);
  double top = 0, thickest = 0, thinnest = 1;
  for (const PlacedPart& part : parts) {
    top = std::max<double>(top, part.shape.b.y() + part.shape.radius_b);
    thickest = std::max<double>(thickest, part.shape.radius_a);
    thinnest = std::min<double>(thinnest, part.shape.radius_a);
  }
  const Eigen::Matrix3Xd joints = JointPositions(native, RestPose(native));
  EXPECT_GT(top, joints(1, native.Find("head")) + 0.15);
  EXPECT_GT(thickest, 2 * thinnest);
}

TEST(Doll, ABodyOfOtherJointsIsCapsules) {
  Skeleton chain = kSmpl;
  chain.joint_names[10] = "left_paw";
  // One for each bone, one across the hips, four of the head.
  EXPECT_EQ(MakeDoll(chain).size(), 28u);
  EXPECT_GT(MakeDoll(kSmpl).size(), 30u);
}

TEST(Doll, MovesRigidlyWithItsJoints) {
  std::mt19937 generator(4);
  const Pose pose = fixtures::RandomPose(kSmpl, generator, 1.5);
  const std::vector<DollPart> doll = MakeDoll(kSmpl);
  const JointPlacement placement = ForwardKinematics(kSmpl, pose);
  const std::vector<PlacedPart> parts = PlaceDoll(doll, placement);
  ASSERT_EQ(parts.size(), doll.size());
  for (size_t i = 0; i < parts.size(); ++i) {
    const DollBall& ball = doll[i].b;
    EXPECT_NEAR((parts[i].shape.b.cast<double>() - placement.positions.col(ball.joint)).norm(),
                ball.offset.norm(), 1e-5);
  }
}

TEST(DollAboveFloor, IsMeasuredFromTheLowestPoint) {
  Pose pose = RestPose(kSmpl);
  EXPECT_NEAR(DollAboveFloor(kSmpl, pose), 0, 1e-9);
  pose.root_position.y() += 0.3;
  EXPECT_NEAR(DollAboveFloor(kSmpl, pose), 0.3, 1e-6);
  // Sitting, legs ahead: the seat is thicker than the joints in it are high.
  for (const int hip : {kSmpl.left_hip, kSmpl.right_hip}) pose.rotations(0, hip) = -M_PI / 2;
  pose.root_position.y() = 0.2;
  EXPECT_NEAR(DollAboveFloor(kSmpl, pose), 0, 0.02);
  EXPECT_GT(JointPositions(kSmpl, pose).row(1).minCoeff(), 0.06);
  // Upside down, a head is below its joint.
  pose = RestPose(kSmpl);
  pose.rotations(2, 0) = M_PI;
  EXPECT_LT(DollAboveFloor(kSmpl, pose), JointPositions(kSmpl, pose).row(1).minCoeff() - 0.1);
}

}  // namespace choreo::doll_test
