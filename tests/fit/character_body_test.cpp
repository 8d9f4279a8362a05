#include "model/fit/bones/character_body.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "model/fit/bones/transfer.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/fit/fit_fixtures.h"
#include "tests/support/expect_error.h"
#include "tests/support/proportions.h"

namespace choreo::character_body_test {

using fixtures::Rigged;
using testing_support::ChildBody;
using testing_support::LongLegs;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

TEST(CharacterBody, StandsLikeSmplFromAnyRestPose) {
  for (const Skeleton& body : {Smpl(), ChildBody(), LongLegs()}) {
    Pose rest = RestPose(body);
    rest.rotations.col(0) << 0, 2.0, 0;
    rest.rotations.col(body.left_shoulder) << 0.1, 0.2, -0.9;
    rest.rotations.col(body.right_shoulder) << 0, 0, 1.2;
    rest.rotations.col(body.left_elbow) << 0, -0.4, 0;
    // Legs apart, feet flat on the floor.
    rest.rotations.col(body.left_hip) << 0, 0, 0.2;
    rest.rotations.col(body.feet[0]) << 0, 0, -0.2;
    rest.rotations.col(body.right_hip) << 0, 0, -0.2;
    rest.rotations.col(body.feet[2]) << 0, 0, 0.2;
    rest.root_position.y() = *StandingHeight(body, rest);
    const CharacterBody made = Rigged(body, rest);
    const Eigen::Matrix3Xd smpl = JointPositions(Smpl(), RestPose(Smpl()));
    const Eigen::Matrix3Xd stands = JointPositions(made.skeleton, RestPose(made.skeleton));
    for (const auto& [from, to] :
         {std::pair("left_shoulder", "left_elbow"), std::pair("left_elbow", "left_wrist"),
          std::pair("right_shoulder", "right_elbow"), std::pair("left_hip", "left_knee"),
          std::pair("right_knee", "right_ankle")}) {
      const auto direction = [&](const Skeleton& skeleton, const Eigen::Matrix3Xd& places) {
        return (places.col(skeleton.Find(to)) - places.col(skeleton.Find(from)))
            .normalized()
            .eval();
      };
      EXPECT_GT(direction(made.skeleton, stands).dot(direction(Smpl(), smpl)), 1 - 1e-9) << to;
    }
    EXPECT_NEAR(stands(1, made.skeleton.feet[1]), 0.02 * CharacterSize(made.skeleton), 0.02);
    EXPECT_GT(stands(2, made.skeleton.feet[1]) - stands(2, made.skeleton.feet[0]), 0.05);
  }
}

TEST(CharacterBody, LyingRigsAndThoseWithoutToesAreSetUpright) {
  const Eigen::Matrix3Xd places = JointPositions(Smpl(), RestPose(Smpl()));
  HumanBones bones = FindHumanBones(Smpl().joint_names);
  // Z is up, and a unit is a centimetre.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).matrix();
  const Eigen::Matrix3Xd lying = 100 * turn * places;
  bones.bones.erase("left_foot");
  bones.bones.erase("right_foot");
  const CharacterBody made = MakeCharacterBody(bones, lying);
  const Eigen::Matrix3Xd stands = JointPositions(made.skeleton, RestPose(made.skeleton));
  EXPECT_NEAR(stands(1, 0), 100 * Smpl().pelvis_height, 2);
  EXPECT_NEAR(stands(1, made.skeleton.feet[1]), 2, 1);
  EXPECT_EQ(made.nodes[static_cast<size_t>(made.skeleton.feet[1])], -1);
}

TEST(CharacterBody, RefusesNonBodies) {
  const Eigen::Matrix3Xd places = JointPositions(Smpl(), RestPose(Smpl()));
  const HumanBones all = FindHumanBones(Smpl().joint_names);
  const auto refuse = [&](const std::string& message, const HumanBones& bones,
                          const Eigen::Matrix3Xd& at) {
    ExpectError(ErrorCode::kInvalidArgument, message, [&] { MakeCharacterBody(bones, at); });
  };
  HumanBones bones = all;
  bones.bones.erase("right_knee");
  refuse("bones: none of them is the right_knee", bones, places);
  bones.bones.erase("left_hip");
  refuse("bones: none of them is the left_hip, right_knee", bones, places);
  refuse(
      "bones: none of them is the pelvis, left_hip, left_knee, left_ankle, left_shoulder, "
      "left_elbow and 8 more",
      HumanBones(), places);
  bones = all;
  bones.bones["left_knee"] = bones.bones["left_ankle"];
  refuse("bones: left_ankle and left_knee are one node", bones, places);
  bones = all;
  bones.bones.erase("spine1");
  refuse("those of the spine are not numbered one after the other", bones, places);
  bones = all;
  for (const char* bone : {"hip", "knee", "ankle", "foot", "shoulder", "elbow", "wrist", "collar"})
    std::swap(bones.bones[std::string("left_") + bone], bones.bones[std::string("right_") + bone]);
  refuse("left and right are exchanged", bones, places);
  Eigen::Matrix3Xd flat = places;
  flat.col(Smpl().left_elbow) = flat.col(Smpl().left_shoulder);
  refuse("left_elbow stands where left_shoulder does", all, flat);
  refuse("stand in one place", all, Eigen::Matrix3Xd::Zero(3, 24));
}

}  // namespace choreo::character_body_test
