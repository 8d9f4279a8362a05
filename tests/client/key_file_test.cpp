#include "client/cli/key_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "model/formats/motion_file.h"
#include "model/motion/kinematics.h"
#include "model/motion/resample.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::cli {
namespace {

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// 24 rotations, the last one given.
std::string Rotations(const std::string& last = "[0, 0, 0]", int joints = 24) {
  std::string text = "[";
  for (int joint = 0; joint + 1 < joints; ++joint)
    text += "[0.1, 0.2, " + std::to_string(joint) + "e-2], ";
  return text + last + "]";
}

std::string File(const std::string& members) { return R"({"keyframes": [{)" + members + "}]}"; }

std::string Key(const std::string& rotations = Rotations(), const std::string& more = "") {
  return File(R"("id": "a", "time": 2.0, "root_position": [1, 0.9, -2], "rotations": )" +
              rotations + more);
}

std::vector<client::KeyPose> Parse(const std::string& text) {
  return ParseKeyFile(text, "keys.json", Body());
}

TEST(KeyFileTest, ReadsAKeyAsItIsWritten) {
  const auto keys = Parse(Key());
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys[0].id, "a");
  EXPECT_EQ(keys[0].time_s, 2.0);
  EXPECT_FALSE(keys[0].frame.has_value());
  EXPECT_EQ(keys[0].pose.root_position, Eigen::Vector3d(1, 0.9, -2));
  ASSERT_EQ(keys[0].pose.rotations.cols(), 24);
  EXPECT_EQ(keys[0].pose.rotations.col(7), Eigen::Vector3d(0.1, 0.2, 0.07));
  EXPECT_TRUE(keys[0].mask.root_position);
  EXPECT_TRUE(keys[0].mask.joints.empty());
}

TEST(KeyFileTest, KeepsTheOrderAndNamesTheNameless) {
  const std::string nameless = R"({"frame": 90, "rotations": )" + Rotations() + "}";
  const auto keys = Parse(R"({"keyframes": [)" + nameless + "," +
                          R"({"id": "b", "time": 1, "rotations": )" + Rotations() + "}]}");
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0].id, "key1");
  EXPECT_EQ(keys[0].frame, 90);
  EXPECT_EQ(keys[1].id, "b");
}

TEST(KeyFileTest, MasksWhatIsLeftOut) {
  const auto keys =
      Parse(File(R"("time": 1, "joints": ["left_elbow", "head"], "rotations": )" + Rotations()));
  EXPECT_FALSE(keys[0].mask.root_position);
  ASSERT_EQ(keys[0].mask.joints.size(), 24U);
  for (int joint = 0; joint < 24; ++joint) {
    const bool wanted = joint == Body().Find("left_elbow") || joint == Body().Find("head");
    EXPECT_EQ(keys[0].mask.joints[static_cast<size_t>(joint)], wanted) << joint;
  }
}

TEST(KeyFileTest, ErrorsNameTheFieldTheValueAndTheLimit) {
  const auto refused = [](const std::string& text, const std::string& part) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { Parse(text); });
  };
  refused("{", "keys.json: is not JSON");
  refused("[]", "keys.json: has no list \"keyframes\"");
  refused(R"({"keyframes": []})", "keys.json:keyframes: is empty");
  refused(R"({"keyframes": [3]})", "keyframes[0]: 3 is not an object");
  refused(Key(Rotations("[7, 3, 3]")), "keyframes[0].rotations[23]: 8.18535 rad exceeds 2π");
  refused(Key(Rotations("[0, 0]")), "keyframes[0].rotations[23]: [0,0] is not a list of 3 numbers");
  refused(Key(Rotations("[0, \"x\", 0]")), "keyframes[0].rotations[23][1]: \"x\" is not a number");
  refused(Key(Rotations("[0, 0, 0]", 23)),
          "keyframes[0].rotations: has 23 entries, not one for each of the 24 joints");
  refused(Key(Rotations(), R"(, "tiem": 3)"), "keyframes[0].tiem: is not known");
  refused(Key(Rotations(), R"(, "frame": 3)"), "keyframes[0].time: stands beside frame");
  refused(File(R"("rotations": )" + Rotations()), "keyframes[0].time: is missing");
  refused(File(R"("time": -1, "rotations": )" + Rotations()),
          "keyframes[0].time: -1 s is before 0");
  refused(File(R"("frame": 1.5, "rotations": )" + Rotations()),
          "keyframes[0].frame: 1.5 is not a whole number");
  refused(File(R"("time": 1)"), "keyframes[0].rotations: is missing");
  refused(File(R"("time": 1, "joints": ["tail"], "rotations": )" + Rotations()),
          "\"tail\" is no joint of smpl24");
  const std::string same = R"({"id": "a", "time": 1, "rotations": )" + Rotations() + "}";
  refused(R"({"keyframes": [)" + same + "," + same + "]}",
          "keyframes[1].id: \"a\" stands for an earlier key");
}

class MotionKeysTest : public testing::Test {
 protected:
  void SetUp() override {
    motion_.fps = 30;
    for (int frame = 0; frame <= 90; ++frame) {
      Pose pose = RestPose(Body());
      pose.root_position.x() = 0.01 * frame;
      pose.rotations(1, 0) = 0.02 * frame;
      motion_.frames.push_back(pose);
    }
    path_ = (folder_ / "walk.bvh").string();
    WriteMotion(path_, Body(), motion_);
  }

  TemporaryFolder folder_;
  Motion motion_;
  std::string path_;
};

TEST_F(MotionKeysTest, TakesPosesOutOfAMotion) {
  const auto keys = ReadKeys(path_ + "@1.2,2.5=8", Body());
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0].id, "walk@1.2");
  EXPECT_EQ(keys[0].time_s, 1.2);
  EXPECT_LT(ComparePoses(Body(), keys[0].pose, motion_.frames[36]).position_m, 1e-5);
  EXPECT_EQ(keys[1].time_s, 8);
  EXPECT_LT(ComparePoses(Body(), keys[1].pose, motion_.frames[75]).position_m, 1e-5);
}

TEST_F(MotionKeysTest, RefusesTimesThatAreNone) {
  for (const char* times : {"", "x", "1,", "-1", "1.2x", "1=", "nan"}) {
    ExpectError(ErrorCode::kInvalidArgument, "is not a time in seconds",
                [&] { ReadKeys(path_ + "@" + times, Body()); });
  }
  ExpectError(ErrorCode::kInvalidArgument, "second 3.5 lies behind the motion's end at 3",
              [&] { ReadKeys(path_ + "@3.5", Body()); });
  ExpectError(ErrorCode::kInvalidArgument, "say which poses", [&] { ReadKeys(path_, Body()); });
  ExpectError(ErrorCode::kNotFound, "absent.json", [&] { ReadKeys("absent.json", Body()); });
}

TEST_F(MotionKeysTest, ReadsAKeyFileByItsPath) {
  const std::string path = (folder_ / "odd@name.json").string();
  std::ofstream(path) << Key();
  EXPECT_EQ(ReadKeys(path, Body()).front().id, "a");
}

}  // namespace
}  // namespace choreo::cli
