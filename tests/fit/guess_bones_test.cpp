#include "model/fit/bones/guess_bones.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "model/fit/bones/character_body.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/proportions.h"

namespace choreo::guess_bones_test {

using testing_support::ChildBody;
using testing_support::LongLegs;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

TEST(GuessBones, FindsABodyByItsPosition) {
  for (const Skeleton& body : {Smpl(), ChildBody(), LongLegs()}) {
    for (const double facing : {0.0, std::numbers::pi}) {
      for (const double down : {0.0, 0.8}) {
        Pose rest = RestPose(body);
        rest.rotations.col(0) << 0, facing, 0;
        rest.rotations.col(body.left_shoulder) << 0, 0, -down;
        rest.rotations.col(body.right_shoulder) << 0, 0, down;
        const HumanBones guess = GuessBones(body.parents, JointPositions(body, rest),
                                            std::vector<bool>(body.parents.size(), true));
        EXPECT_EQ(MissingBones(guess), "");
        for (const auto& [bone, node] : guess.bones)
          EXPECT_EQ(body.joint_names[static_cast<size_t>(node)], bone) << facing << " " << down;
      }
    }
  }
}

TEST(GuessBones, FindsABodyWithAnyAxes) {
  const Skeleton& body = Smpl();
  const Eigen::Matrix3Xd places = JointPositions(body, RestPose(body));
  for (const Eigen::Vector3d& up :
       {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(-1, 0, 0)}) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const Eigen::Matrix3d turn =
          Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), up).toRotationMatrix() *
          Eigen::AngleAxisd(quarter * std::numbers::pi / 2, Eigen::Vector3d::UnitY())
              .toRotationMatrix();
      Eigen::Matrix3d upright;
      const HumanBones guess = GuessBones(body.parents, turn * places,
                                          std::vector<bool>(body.parents.size(), true), &upright);
      EXPECT_EQ(MissingBones(guess), "");
      for (const auto& [bone, node] : guess.bones)
        EXPECT_EQ(body.joint_names[static_cast<size_t>(node)], bone) << up.transpose() << quarter;
      EXPECT_TRUE((upright * up).isApprox(Eigen::Vector3d::UnitY(), 1e-9));
    }
  }
}

TEST(GuessBones, GuessesNothingWithoutABody) {
  const Eigen::Matrix3Xd line = Eigen::Matrix3Xd::Zero(3, 30);
  std::vector<int> parents;
  for (int i = 0; i < 30; ++i) parents.push_back(i - 1);
  EXPECT_NE(MissingBones(GuessBones(parents, line, std::vector<bool>(30, true))), "");
  EXPECT_NE(MissingBones(GuessBones({}, Eigen::Matrix3Xd(3, 0), {})), "");
}

}  // namespace choreo::guess_bones_test
