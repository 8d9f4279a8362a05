#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "model/formats/motion_file.h"
#include "tests/client/run_choreo.h"
#include "tests/support/rig_files.h"
#include "tests/support/temporary_folder.h"

namespace choreo::convert_command_test {

using namespace testing_support;
using testing::HasSubstr;

class ConvertCommandTest : public testing::Test {
 protected:
  std::string At(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  Outcome Convert(const std::string& in, const std::string& options = "",
                  const std::string& out = "out.npz") const {
    return Choreo("convert " + At(in) + " " + At(out) + " " + options);
  }

  TemporaryFolder folder_;
};

TEST_F(ConvertCommandTest, NotesAWrongFileInOneLine) {
  const Eigen::Matrix3d z_up{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  WriteBvh(folder_ / "z.bvh", MakeBvh({.world = z_up}));
  const Outcome taken = Convert("z.bvh");
  EXPECT_EQ(taken.code, 0);
  EXPECT_THAT(taken.said, HasSubstr("note: " + (folder_ / "z.bvh").string() + ": read as z up"));
  EXPECT_EQ(std::ranges::count(taken.said, '\n'), 2) << taken.said;
  EXPECT_TRUE(Convert("z.bvh", "--up z").said.ends_with(".npz\n"));
  EXPECT_THAT(Convert("z.bvh", "--up w").said, HasSubstr("--up: \"w\" is none of x, y, z"));
  EXPECT_THAT(Convert("z.bvh", "--animation a").said, HasSubstr("--animation: is for .glb"));
  EXPECT_THAT(Convert("z.bvh", "--body B").said, HasSubstr("--body: \"B\" is none of its bodies"));
}

// Notes name options; other commands' notes say whose they are.
TEST_F(ConvertCommandTest, NotesNameTheCommandThatHasTheOption) {
  const Eigen::Matrix3d z_up{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  WriteBvh(folder_ / "z.bvh", MakeBvh({.world = z_up}));
  EXPECT_THAT(Convert("z.bvh").said, HasSubstr("; --up y makes it lie"));
  EXPECT_THAT(Choreo("pose --from " + At("z.bvh@0.5")).said,
              HasSubstr("; choreo convert --up y makes it lie"));
}

TEST_F(ConvertCommandTest, TakesAMapForMeaninglessNames) {
  const RigNames nameless = [](const std::string& bone) {
    return "bone" + std::to_string(RigIndex(bone));
  };
  WriteBvh(folder_ / "a.bvh", MakeBvh({.names = nameless}));
  const Outcome asked = Convert("a.bvh");
  EXPECT_EQ(asked.code, 1);
  EXPECT_THAT(asked.said, HasSubstr("a.bvh: its names do not say which bone is the pelvis"));
  EXPECT_THAT(asked.said, HasSubstr("out.map.json is a guess"));
  EXPECT_GT(std::filesystem::file_size(folder_ / "out.map.png"), 5000U);
  const Outcome mapped = Convert("a.bvh", "--map " + At("out.map.json"));
  EXPECT_EQ(mapped.code, 0) << mapped.said;
  const Outcome too = Convert("a.bvh", "--motion-map " + At("out.map.json"));
  EXPECT_EQ(too.code, 0) << too.said;
  std::ofstream(folder_ / "half.json") << R"({"bones": {"pelvis": "bone0"}})";
  EXPECT_THAT(Convert("a.bvh", "--map " + At("half.json")).said,
              HasSubstr("half.json: does not say which bone is the left_hip"));
  EXPECT_THAT(Choreo("render " + At("a.bvh") + " --out " + At("a.png")).said,
              HasSubstr("choreo convert writes a guess"));
}

TEST_F(ConvertCommandTest, RoundTripsAnAvatarsMotion) {
  WriteBvh(folder_ / "a.bvh", MakeBvh({}));
  ASSERT_EQ(Convert("a.bvh", "", "a.vrma").code, 0);
  ASSERT_EQ(Convert("a.vrma", "", "b.npz").code, 0);
  const Motion there = ReadMotion(folder_ / "a.bvh", Skeleton::Smpl24());
  const Motion back = ReadMotion(folder_ / "b.npz", Skeleton::Smpl24());
  ASSERT_EQ(there.frames.size(), back.frames.size());
  EXPECT_LT((there.frames[9].rotations - back.frames[9].rotations).norm(), 1e-4);
}

}  // namespace choreo::convert_command_test
