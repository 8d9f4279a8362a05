#include "client/authoring/keys/key_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/keys/key_file.h"
#include "model/motion/kinematics.h"
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

}  // namespace choreo::authoring::key_faults_test
