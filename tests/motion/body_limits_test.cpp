#include "model/motion/pose/body_limits.h"

#include <gtest/gtest.h>

#include <vector>

#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

// A body that slides at `m_per_s` along z for a frame, after a still one.
double ExcessOfSliding(double m_per_s, double fps) {
  const Skeleton skeleton = Skeleton::Smpl24();
  const Pose before = StandingPose(skeleton);
  std::vector<Pose> poses(2, before);
  poses[1].root_position.z() += m_per_s / fps;
  return SpeedExcess(skeleton, before, poses, fps);
}

TEST(SpeedExcess, IsThatOfTheWholeBodyWhereAllJointsAreFast) {
  EXPECT_NEAR(ExcessOfSliding(kFastestBody, 30), 1, 1e-9);
  EXPECT_NEAR(ExcessOfSliding(2 * kFastestBody, 120), 2, 1e-9);
  EXPECT_EQ(ExcessOfSliding(0, 30), 0);
}

TEST(SpeedExcess, IsThatOfAJointThatAloneIsFast) {
  const Skeleton skeleton = Skeleton::Smpl24();
  const Pose before = StandingPose(skeleton);
  Pose thrown = before;
  thrown.rotations.col(skeleton.Find("left_shoulder")).z() += 1;
  const FastStep step = FindFastestStep(skeleton, before, {&thrown, 1}, 30);
  ASSERT_GT(step.m_per_s, kFastestJoint);
  EXPECT_NEAR(SpeedExcess(skeleton, before, {&thrown, 1}, 30), step.m_per_s / kFastestJoint, 1e-9);
}

}  // namespace
}  // namespace choreo
