#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "client/authoring/keys/key_file.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/resample.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

/// Keys that are poses of a motion: FILE@SECOND.
namespace choreo::authoring::motion_keys_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

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

TEST_F(MotionKeysTest, TakesTheShortestWayAfterAnyNumberOfTurns) {
  // One and a half turns about the axis of a pirouette: the file's branch ends at 3 pi.
  for (size_t frame = 0; frame < motion_.frames.size(); ++frame)
    motion_.frames[frame].rotations(1, 0) = 3 * M_PI * static_cast<double>(frame) / 90;
  WriteMotion(path_, Body(), motion_);
  ASSERT_GT(ReadMotion(path_, Body()).frames.back().rotations.col(0).norm(), 2.9 * M_PI);
  for (const client::KeyPose& key : ReadKeys(path_ + "@0,1.9,2.5,3", Body())) {
    EXPECT_LE(key.pose.rotations.colwise().norm().maxCoeff(), M_PI + 1e-9) << key.id;
    const auto frame = static_cast<size_t>(std::lround(30 * key.time_s));
    EXPECT_LT(ComparePoses(Body(), key.pose, motion_.frames[frame]).position_m, 1e-5) << key.id;
  }
}

TEST_F(MotionKeysTest, RefusesInvalidTimes) {
  for (const char* times : {"", "x", "1,", "-1", "1.2x", "1=", "nan"}) {
    ExpectError(ErrorCode::kInvalidArgument, path_ + "@" + times,
                [&] { ReadKeys(path_ + "@" + times, Body()); });
  }
  ExpectError(ErrorCode::kInvalidArgument, "second 3.5 is after the motion's end at 3",
              [&] { ReadKeys(path_ + "@3.5", Body()); });
  ExpectError(ErrorCode::kInvalidArgument, "name its poses", [&] { ReadKeys(path_, Body()); });
  ExpectError(ErrorCode::kNotFound, "absent.json", [&] { ReadKeys("absent.json", Body()); });
  ExpectError(ErrorCode::kInvalidArgument, "is a folder, not a key file",
              [&] { ReadKeys(folder_.path().string(), Body()); });
}

TEST_F(MotionKeysTest, ReadsAKeyFileByItsPath) {
  const std::string path = (folder_ / "odd@name.json").string();
  std::ofstream(path) << R"({"keyframes": [{"id": "a", "time": 2, "pose": "stand"}]})";
  EXPECT_EQ(ReadKeys(path, Body()).front().id, "a");
}

}  // namespace choreo::authoring::motion_keys_test
