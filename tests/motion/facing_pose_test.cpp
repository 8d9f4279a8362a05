#include "model/motion/pose/facing_pose.h"

#include <gtest/gtest.h>

#include <numbers>

#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/synthetic_clips.h"

namespace choreo::facing_pose_test {

constexpr double kPi = std::numbers::pi;

TEST(FacingPose, DoesNotDependOnPlaceOrHeading) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  const Pose pose = testing_support::SyntheticClip("a", 20, 0.3, false).motion.frames.back();
  const GroundFrame elsewhere{.origin = {1, 0, -2}, .heading = 2.1};
  const FacingPose here = FacingOf(skeleton, pose),
                   there = FacingOf(skeleton, elsewhere.ToWorld(pose));
  EXPECT_LT((here.joints - there.joints).norm(), 1e-9);
  EXPECT_NEAR(NearestTurn(there.heading - here.heading, 2.1), 2.1, 1e-9);
  EXPECT_LT((PositionsOf(there) - JointPositions(skeleton, elsewhere.ToWorld(pose))).norm(), 1e-9);
}

TEST(FacingPose, TurnsAreCountedFromTheNearestHeading) {
  EXPECT_NEAR(NearestTurn(0.1, 2 * kPi), 2 * kPi + 0.1, 1e-12);
  EXPECT_NEAR(NearestTurn(kPi - 0.1, -kPi), -kPi - 0.1, 1e-12);
  EXPECT_NEAR(NearestTurn(7 * kPi + 0.5, 0), -kPi + 0.5, 1e-12);
}

}  // namespace choreo::facing_pose_test
