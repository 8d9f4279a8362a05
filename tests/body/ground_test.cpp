#include "model/body/ground.h"

#include <gtest/gtest.h>

#include "model/motion/kinematics.h"

namespace choreo {
namespace {

const Skeleton& Body() { return Skeleton::Smpl24(); }

TEST(DollAboveFloor, IsMeasuredFromWhatTouchesFirst) {
  Pose pose = RestPose(Body());
  EXPECT_NEAR(DollAboveFloor(Body(), pose), 0, 1e-9);
  pose.root_position.y() += 0.3;
  EXPECT_NEAR(DollAboveFloor(Body(), pose), 0.3, 1e-6);
  // Sitting, legs ahead: the seat is thicker than the joints in it are high.
  for (const int hip : {Body().left_hip, Body().right_hip}) pose.rotations(0, hip) = -M_PI / 2;
  pose.root_position.y() = 0.2;
  EXPECT_NEAR(DollAboveFloor(Body(), pose), 0, 0.02);
  EXPECT_GT(JointPositions(Body(), pose).row(1).minCoeff(), 0.06);
  // Upside down, a head is below its joint.
  pose = RestPose(Body());
  pose.rotations(2, 0) = M_PI;
  EXPECT_LT(DollAboveFloor(Body(), pose), JointPositions(Body(), pose).row(1).minCoeff() - 0.1);
}

}  // namespace
}  // namespace choreo
