#include "client/authoring/keys/key_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/keys/key_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::authoring::key_faults_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

TEST(KeyFaultsTest, TheDemoBeginsQuicklyAndBowsLast) {
  const auto keys = ReadKeys(SOURCE_FOLDER "/examples/demo.json", Skeleton::Smpl24());
  EXPECT_TRUE(KeyFaults(keys, 30, Skeleton::Smpl24()).empty());
  EXPECT_EQ(keys.front().time_s, 0);
  EXPECT_LT(keys[1].time_s, 2);
  EXPECT_EQ(keys.back().id, "bow");
  EXPECT_LT(keys.back().time_s, 24);
}

TEST(KeyFaultsTest, KeysOfADanceAreTooCloseInTheWordsOfTheirFile) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& when, const std::string& message) {
    std::ofstream(folder / "close.json") << R"({"keyframes": [{"id": "b", "pose": "kick", )" + when;
    ExpectError(ErrorCode::kInvalidArgument, (folder / "close.json").string() + message, [&] {
      ReadDanceKeys({(folder / "close.json").string()}, {300, 30}, Body());
    });
  };
  refused(
      R"("time": 2.02}, {"id": "a", "pose": "bow", "time": 2}]})",
      ":keyframes[0].time: key \"b\" at 2.02 s is closer than 2 frames (0.067 s) to key \"a\" at "
      "2 s");
  refused(
      R"("frame": 61}, {"id": "a", "pose": "bow", "frame": 60}]})",
      ":keyframes[0].frame: key \"b\" at frame 61 is closer than 2 frames (0.067 s) to key \"a\" "
      "at frame 60");
}

// The last pose is in the air for too long, whatever the first one's name says.
TEST(KeyFaultsTest, AKeyHasNoFaultsOfOthersWithSimilarNames) {
  const Skeleton& body = Skeleton::Smpl24();
  Pose jump = RestPose(body);
  jump.root_position.y() += 0.4;
  const client::KeyPose key{.id = "b", .time_s = 1.5, .pose = jump};
  EXPECT_TRUE(KeyFaults(key, 45, 30, body, {{"from \"b\"", 1, jump}, {"c", 2.2, jump}}).empty());
}

TEST(KeyFaultsTest, TheWayFromAHeldKeyBeginsWhereItsHoldEnds) {
  const Skeleton& body = Skeleton::Smpl24();
  const Pose stand = RestPose(body);
  Pose low = stand;
  low.root_position.y() -= 0.6;
  const client::KeyPose plank{.id = "plank", .time_s = 2, .pose = low};
  const std::vector<TimedPose> around = {{"a", 1, stand}, {"up", 3.5, stand}};
  EXPECT_TRUE(KeyFaults(plank, 60, 30, body, around).empty());
  const auto faults = KeyFaults(plank, 90, 30, body, around);  // held for a second
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_THAT(faults[0].message,
              testing::HasSubstr("rise 0.6 m in 0.5 s from \"plank\" to \"up\""));
}

TEST(KeyFaultsTest, AJumpWithoutAPlaceIsWarnedOf) {
  const Skeleton& body = Skeleton::Smpl24();
  const auto faults = [&](const std::string& key) {
    const std::string text = R"({"keyframes": [{"time": 1, )" + key + "}]}";
    DanceKeys keys;
    keys.poses = ParseKeyFile(text, "keys.json", body, &keys.places);
    return KeyFaults(keys, 30, body);
  };
  const auto lost = faults(R"("id": "up", "pose": "star_jump")");
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].frame, 30);
  EXPECT_THAT(lost[0].message, testing::HasSubstr("key \"up\": the pose is 0."));
  EXPECT_THAT(lost[0].message, testing::HasSubstr("\"place\": [x, z]"));
  EXPECT_TRUE(faults(R"("pose": "star_jump", "place": [0, 0])").empty());
  EXPECT_TRUE(faults(R"("pose": "crouch")").empty());
  EXPECT_TRUE(faults(R"("joints": {"left_knee": 90})").empty());
}

// As in motion/pose/pose_faults.h.
TEST(KeyFaultsTest, TiptoeIsNoJump) {
  client::KeyPose key{.id = "up", .time_s = 1, .pose = RestPose(Body())};
  key.mask.root_position = false;
  key.pose.root_position.y() += 0.12;
  const auto count = [&] { return KeyFaults(std::vector{key}, 30, Body()).size(); };
  EXPECT_EQ(count(), 0U);
  key.pose.root_position.y() += 0.1;
  EXPECT_EQ(count(), 1U);
}

/// The faults of keys of the library's poses, each at its time, with or without a place.
std::vector<client::Warning> FaultsOf(const std::string& keys) {
  DanceKeys read;
  read.poses = ParseKeyFile("{\"keyframes\": [" + keys + "]}", "keys.json", Body(), &read.places);
  return KeyFaults(read, 30, Body());
}

TEST(KeyFaultsTest, AJumpOutOfAFloorPoseNeedsTimeToRise) {
  const std::string stand = R"({"time": 0, "pose": "stand", "place": [0, 0]}, )";
  const std::string splits = R"({"id": "low", "time": 3, "pose": "splits", "place": [0, 0]}, )";
  const auto jump = [](const std::string& time) {
    return R"({"id": "up", "pose": "star_jump", "place": [0, 0], "hit": 1, "time": )" + time + "}";
  };
  const auto faults = FaultsOf(stand + splits + jump("3.5"));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].frame, 105);
  EXPECT_THAT(faults[0].message,
              testing::ContainsRegex("key \"up\" .*the pelvis would rise 0.7[0-9] m in 0.2[0-9] s "
                                     "from \"low\" to \"the take-off of up\"; that takes 0.7"));
  EXPECT_EQ(FaultsOf(stand + splits + jump("3.25")).size(), 1U) << "less than the flight takes";
  EXPECT_THAT(FaultsOf(stand + splits + jump("4.2")), testing::IsEmpty());
  const std::string kneel = R"({"time": 3, "pose": "kneel", "place": [0, 0]}, )";
  EXPECT_EQ(FaultsOf(stand + kneel + jump("3.5")).size(), 1U);
  // Jumps begin and end in a bend of the knees.
  const std::string crouch = R"({"time": 3, "pose": "crouch", "place": [0, 0]}, )";
  EXPECT_THAT(FaultsOf(stand + crouch + jump("3.6")), testing::IsEmpty());

  const auto landed =
      FaultsOf(stand + jump("3") + R"(, {"id": "low", "time": 3.6, "pose": "splits", "hit": 0})");
  ASSERT_EQ(landed.size(), 2U) << "and a hit without time";
  EXPECT_THAT(landed[1].message,
              testing::ContainsRegex("the pelvis would sink 0.7[0-9] m in 0.3[0-9]* s from \"the "
                                     "landing of up\" to \"low\""));
}

TEST(KeyFaultsTest, AJumpSetInADanceAfterAFloorPoseNeedsTimeToRise) {
  const auto keys = ParseKeyFile(R"({"keyframes": [
    {"id": "low", "time": 3, "pose": "splits", "place": [0, 0]},
    {"id": "up", "time": 3.5, "pose": "star_jump", "place": [0, 0]}]})",
                                 "keys.json", Body());
  const std::vector<TimedPose> around = {{"low", 3, keys[0].pose}};
  const auto faults = KeyFaults(keys[1], 105, 30, Body(), around);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_THAT(faults[0].message, testing::HasSubstr("to \"the take-off of up\""));
}

// The dance leads down to the floor by itself.
TEST(KeyFaultsTest, TheKeyThatLandsAJumpNeedsNoPlace) {
  EXPECT_THAT(FaultsOf(R"({"time": 1, "pose": "stand", "place": [0, 0]},
                          {"time": 3, "pose": "tuck_jump", "place": [0.3, 0]},
                          {"time": 3.7, "pose": "stand"})"),
              testing::IsEmpty());
}

}  // namespace choreo::authoring::key_faults_test
