#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/formats/bvh/bvh.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/command_fixture.h"

namespace choreo::bvh_options_test {

using testing::Contains;
using testing::HasSubstr;

class BvhOptionsTest : public CommandTest {
 protected:
  void ExpectRefused(const std::string& arguments, const std::string& message) const {
    const Outcome outcome = Choreo(arguments);
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.said, HasSubstr(message));
  }
};

TEST_F(BvhOptionsTest, WritesTheRequestedNamesAndUnit) {
  const Outcome danced =
      Choreo("dance --seconds 1 -k none --names mixamo --unit m" + Server() + "-o " + At("m.bvh"));
  ASSERT_EQ(danced.code, 0) << danced.said;
  const BvhFile mixamo = ReadBvh(folder_ / "m.bvh");
  EXPECT_THAT(mixamo.JointNames(), Contains("mixamorig:LeftUpLeg"));
  EXPECT_NEAR(mixamo.joints[0].offset.y(), Skeleton::Smpl24().pelvis_height, 1e-6);
  for (const std::string names : {"smpl", "humanik", "ue"}) {
    const Outcome outcome =
        Choreo("convert " + At("m.bvh") + " " + At(names + ".bvh") + " --names " + names);
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    const Motion a = ReadMotion(folder_ / "m.bvh", Skeleton::Smpl24());
    const Motion b = ReadMotion(folder_ / (names + ".bvh"), Skeleton::Smpl24());
    ASSERT_EQ(a.frames.size(), b.frames.size());
    for (size_t i = 0; i < a.frames.size(); ++i) {
      const PoseError error = ComparePoses(Skeleton::Smpl24(), a.frames[i], b.frames[i]);
      EXPECT_LT(error.position_m, 1e-5);
      EXPECT_LT(error.angle_deg, 1e-3);
    }
  }
}

TEST_F(BvhOptionsTest, NamesImpossibleOptions) {
  WriteMotion(folder_ / "a.bvh", Skeleton::Smpl24(),
              {.fps = 30, .frames = {RestPose(Skeleton::Smpl24())}});
  const std::string convert = "convert " + At("a.bvh") + " ";
  ExpectRefused(convert + At("b.bvh") + " --names maya",
                "--names: \"maya\" is none of smpl, mixamo, humanik, ue");
  ExpectRefused(convert + At("b.bvh") + " --unit ft", "\"ft\" is neither m nor cm");
  ExpectRefused(convert + At("b.npz") + " --names ue", "--names: is for a .bvh, not for");
  ExpectRefused(convert + At("b.glb") + " --unit m", "--unit: is for a .bvh, not for");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.bvh"));
}

}  // namespace choreo::bvh_options_test
