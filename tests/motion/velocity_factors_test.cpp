#include "model/motion/controls/velocity_factors.h"

#include <gtest/gtest.h>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/expect_error.h"

namespace choreo::velocity_factors_test {

class VelocityFactorsTest : public testing::Test {
 protected:
  std::array<double, kBodyParts> Factors(const Eigen::Matrix3Xd& later) const {
    return PartSpeeds(weights_, rest_, later);
  }

  const Skeleton& body_ = Skeleton::Smpl24();
  const BodyPartWeights weights_ = WeighBodyParts(body_);
  const Eigen::Matrix3Xd rest_ = JointPositions(body_, RestPose(body_));
};

TEST_F(VelocityFactorsTest, EveryJointHasOnePartAndEveryPartSumsToOne) {
  for (int joint = 0; joint < body_.joints(); ++joint) {
    EXPECT_EQ((weights_.col(joint).array() > 0).count(), 1) << body_.joint_names[joint];
  }
  for (int part = 0; part < kBodyParts; ++part) EXPECT_NEAR(weights_.row(part).sum(), 1, 1e-12);
  // Trunk: root, three spine joints and the neck 1, the head 2. Legs: 1 + 2 + 3 + 4. Arms: a
  // collar's 1 more.
  EXPECT_DOUBLE_EQ(weights_(0, body_.Find("head")), 2.0 / 7);
  EXPECT_DOUBLE_EQ(weights_(3, body_.Find("left_foot")), 4.0 / 10);
  EXPECT_DOUBLE_EQ(weights_(2, body_.Find("right_hand")), 4.0 / 11);
}

TEST_F(VelocityFactorsTest, OneJointMovesItsPartByItsShare) {
  Eigen::Matrix3Xd later = rest_;
  later.col(body_.Find("left_wrist")) += Eigen::Vector3d(0, 0.03, 0.04);
  const auto factors = Factors(later);
  EXPECT_NEAR(factors[static_cast<int>(BodyPart::kLeftArm)], 0.05 * 3 / 11, 1e-12);
  for (const BodyPart still :
       {BodyPart::kTrunk, BodyPart::kRightArm, BodyPart::kLeftLeg, BodyPart::kRightLeg}) {
    EXPECT_EQ(factors[static_cast<int>(still)], 0);
  }
}

TEST_F(VelocityFactorsTest, TravellingMovesTheTrunkByTheRootAlone) {
  const auto factors = Factors(rest_.colwise() + Eigen::Vector3d(0.06, 0, -0.08));
  EXPECT_NEAR(factors[0], 0.1 / 7, 1e-12);
  for (int part = 1; part < kBodyParts; ++part) EXPECT_NEAR(factors[part], 0, 1e-12);
}

TEST_F(VelocityFactorsTest, DoNotDependOnWhereTheSceneStands) {
  std::mt19937 generator(3);
  const Eigen::Matrix3Xd before = JointPositions(body_, fixtures::RandomPose(body_, generator));
  const Eigen::Matrix3Xd after = JointPositions(body_, fixtures::RandomPose(body_, generator));
  const Eigen::Matrix3d turn = HeadingRotation(1.1);
  const Eigen::Vector3d shift(3, 0, -2);
  const auto here = PartSpeeds(weights_, before, after);
  const auto there =
      PartSpeeds(weights_, (turn * before).colwise() + shift, (turn * after).colwise() + shift);
  for (int part = 0; part < kBodyParts; ++part) EXPECT_NEAR(here[part], there[part], 1e-12);
}

TEST_F(VelocityFactorsTest, HaveNames) {
  for (int part = 0; part < kBodyParts; ++part) {
    EXPECT_EQ(FindBodyPart(kBodyPartNames[part]), static_cast<BodyPart>(part));
  }
  EXPECT_EQ(FindBodyPart("tail"), std::nullopt);
}

TEST_F(VelocityFactorsTest, RefuseAnUnknownBody) {
  Skeleton odd = body_;
  odd.joint_names[odd.Find("head")] = "antenna";
  ExpectError(ErrorCode::kInvalidArgument, "'antenna' belongs to no body part",
              [&] { WeighBodyParts(odd); });
  Skeleton root;
  root.name = "ball";
  root.joint_names = {"centre"};
  root.parents = {-1};
  root.offsets.setZero(3, 1);
  ExpectError(ErrorCode::kInvalidArgument, "no joint belongs to the left_arm",
              [&] { WeighBodyParts(root); });
}

}  // namespace choreo::velocity_factors_test
