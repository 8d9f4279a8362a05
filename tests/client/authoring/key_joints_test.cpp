#include "client/authoring/keys/key_joints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_library.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"

namespace choreo::authoring::key_joints_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

std::vector<client::KeyPose> Parse(const std::string& members) {
  return ParseKeyFile(R"({"keyframes": [{)" + members + "}]}", "keys.json", Body());
}

TEST(KeyJointsTest, NamesAPoseOfTheLibraryAndWhereItStands) {
  const auto keys = Parse(R"("time": 2, "pose": "kick", "place": [1, -0.5], "facing": 90)");
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_TRUE(keys[0].mask.root_position);
  EXPECT_TRUE(keys[0].mask.joints.empty());
  const GroundFrame place{.origin = {1, 0, -0.5}, .heading = M_PI / 2};
  const Pose expected = place.ToWorld(FindLibraryPose("kick").pose);
  EXPECT_LT(ComparePoses(Body(), keys[0].pose, expected).position_m, 1e-9);
  // It faced the audience along z, and faces along x now.
  const auto facing = ForwardKinematics(Body(), keys[0].pose).rotations[0].col(2).eval();
  EXPECT_GT(facing.x(), 0.8);
  EXPECT_FALSE(Parse(R"("time": 2, "pose": "kick")")[0].mask.root_position);
}

TEST(KeyJointsTest, TurnsJointsOfAPoseToDegrees) {
  const auto keys =
      Parse(R"("time": 2, "pose": "kick", "joints": {"left_elbow": 90, "head": [0, 30, 0]})");
  EXPECT_TRUE(keys[0].mask.joints.empty());  // all of the pose is asked for
  const Hinge elbow = Hinges(Body())[2];
  EXPECT_NEAR(elbow.axis.dot(keys[0].pose.rotations.col(elbow.joint)), M_PI / 2, 1e-12);
  EXPECT_NEAR(keys[0].pose.rotations(1, Body().Find("head")), M_PI / 6, 1e-12);
  const int knee = Body().left_knee;
  EXPECT_EQ(keys[0].pose.rotations.col(knee), FindLibraryPose("kick").pose.rotations.col(knee));
}

TEST(KeyJointsTest, JointsAloneAreAPartialKey) {
  const auto keys = Parse(R"("time": 2, "joints": {"left_shoulder": [0, 0, 80]})");
  EXPECT_FALSE(keys[0].mask.root_position);
  for (int joint = 0; joint < 24; ++joint)
    EXPECT_EQ(keys[0].mask.Constrains(joint), joint == Body().left_shoulder) << joint;
  EXPECT_NEAR(keys[0].pose.rotations(2, Body().left_shoulder), 80 * M_PI / 180, 1e-12);
}

TEST(KeyJointsTest, AListLimitsAPoseToJointsAndLimbs) {
  const auto keys = Parse(R"("time": 2, "pose": "victory_v", "joints": ["left_arm", "head"])");
  for (int joint = 0; joint < 24; ++joint) {
    const std::string& name = Body().joint_names[static_cast<size_t>(joint)];
    const bool arm = name == "left_shoulder" || name == "left_elbow" || name == "left_wrist" ||
                     name == "left_hand";
    EXPECT_EQ(keys[0].mask.Constrains(joint), arm || name == "head") << name;
  }
  const auto legs = Parse(R"("time": 2, "pose": "kick", "joints": ["legs"])")[0].mask.joints;
  EXPECT_EQ(std::count(legs.begin(), legs.end(), true), 8);
}

TEST(KeyJointsTest, HoldsAPoseWithKeysUpToItsEnd) {
  const auto keys = Parse(R"("id": "a", "time": 2, "pose": "kick", "hold": 1.25)");
  ASSERT_EQ(keys.size(), 7U);
  EXPECT_EQ(keys[0].id, "a");
  EXPECT_EQ(keys[6].id, "a held 6");
  EXPECT_NEAR(keys[6].time_s, 3.25, 1e-12);
  for (size_t i = 1; i < keys.size(); ++i) {
    // At 30 frames a second no two of them come closer than six frames.
    EXPECT_GE(std::llround(30 * keys[i].time_s) - std::llround(30 * keys[i - 1].time_s), 6);
    EXPECT_EQ(keys[i].pose.rotations, keys[0].pose.rotations);
  }
}

TEST(KeyJointsTest, ErrorsNameTheFieldTheValueAndTheLimit) {
  const auto refused = [](const std::string& members, const std::string& part) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { Parse(members); });
  };
  refused(R"("time": 1, "pose": "kik")",
          "keyframes[0].pose: kik: is not a pose of the library; did you mean kick?");
  refused(R"("time": 1, "pose": 3)", "keyframes[0].pose: 3 is not a name");
  refused(R"("time": 1, "pose": "kick", "root_position": [0, 1, 0])",
          "keyframes[0].root_position: cannot be combined with pose");
  refused(R"("time": 1, "pose": "kick", "place": [1])", "keyframes[0].place: [1] is not [x, z]");
  refused(R"("time": 1, "pose": "kick", "facing": 400)",
          "keyframes[0].facing: 400 degrees, must be -360 to 360");
  refused(R"("time": 1, "joints": {"left_knee": -20})",
          "keyframes[0].joints.left_knee: left_knee is at -20 degrees, must be 0 to 165");
  refused(R"("time": 1, "joints": {"tail": 1})", "keyframes[0].joints: \"tail\" is not a joint");
  refused(R"("time": 1, "joints": {})", "keyframes[0].joints: names no joint");
  refused(R"("time": 1, "pose": "kick", "joints": "arms")", "is not a list of joint names");
  refused(R"("time": 1, "pose": "kick", "hold": 0)", "keyframes[0].hold: 0 s, must be 0.1 to 60");
  refused(R"("frame": 1, "pose": "kick", "hold": 1)", "keyframes[0].hold: goes with time");
}

}  // namespace choreo::authoring::key_joints_test
