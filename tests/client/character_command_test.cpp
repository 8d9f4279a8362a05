#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "model/formats/motion_file.h"
#include "tests/client/run_choreo.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/character_rigs.h"
#include "tests/support/temporary_folder.h"

namespace choreo::character_command_test {

using testing::HasSubstr;
using testing_support::WriteCharacter;

class CharacterCommandTest : public testing::Test {
 protected:
  CharacterCommandTest() {
    WriteMotion(folder_ / "dance.npz", Skeleton::Smpl24(),
                fixtures::SmoothMotion(Skeleton::Smpl24(), 3, 12, 30));
  }
  std::string At(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  Outcome Convert(const std::string& options, const std::string& out = "out.glb") const {
    return Choreo("convert " + At("dance.npz") + " " + At(out) + " " + options);
  }
  void ExpectRefused(const Outcome& outcome, const std::string& message) const {
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.said, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.glb"));
  }

  TemporaryFolder folder_;
};

TEST_F(CharacterCommandTest, ACharacterDances) {
  WriteCharacter(folder_ / "hero.glb", {.arms_down = 45, .rolled = true, .armature_scale = 0.01});
  const Outcome outcome = Convert("--fps 60 --character " + At("hero.glb"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  // What we read back is about the dance: it was Mixamo's names, and is fitted to SMPL's.
  const SkeletonMotion back = ReadMotion(folder_ / "out.glb");
  EXPECT_EQ(back.motion.fps, 60);
  EXPECT_EQ(back.motion.frames.size(), 23U);
}

TEST_F(CharacterCommandTest, AReportSaysWhatHandsDo) {
  WriteCharacter(folder_ / "hero.glb", {});
  const auto with = [&](const std::string& hands) {
    std::ofstream(folder_ / "report.json")
        << R"({"fps": 30, "keyframes": [{"id": "a", "frame": 3, "hands": )" << hands << "}]}";
    return Convert("--character " + At("hero.glb") + " --report " + At("report.json"));
  };
  ExpectRefused(Convert("--report " + At("hero.glb")), "--report: goes with --character");
  ExpectRefused(with("\"claw\""), "report.json:keyframes[0].hands: \"claw\" is none of rest");
  const Outcome outcome = with("\"fist\"");
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, testing::Not(HasSubstr("note: --hands")));
  EXPECT_THAT(
      Convert("--character " + At("hero.glb") + " --report " + At("report.json") + " --hands point")
          .said,
      HasSubstr("note: --hands has no effect: keys of "));
}

TEST_F(CharacterCommandTest, AsksForAMapOfMeaninglessNames) {
  WriteCharacter(folder_ / "hero.glb", {.rig = "", .arms_down = 20});
  ExpectRefused(Convert("--character " + At("hero.glb")),
                "do not say which bone is the pelvis, left_hip, left_knee");
  const nlohmann::json map = ReadJson(folder_ / "out.map.json");
  EXPECT_EQ(map["bones"]["left_knee"], "bone.4");
  EXPECT_GT(std::filesystem::file_size(folder_ / "out.map.png"), 5000U);
  // A file that somebody may have corrected is not overwritten.
  ExpectRefused(Convert("--character " + At("hero.glb")), "is there already");
  const Outcome mapped = Convert("--character " + At("hero.glb") + " --map " + At("out.map.json"));
  EXPECT_EQ(mapped.code, 0) << mapped.said;
}

TEST_F(CharacterCommandTest, MapOverridesNames) {
  WriteCharacter(folder_ / "hero.glb", {});
  const auto mapped = [&](const std::string& map) {
    std::ofstream(folder_ / "map.json") << map;
    return Convert("--character " + At("hero.glb") + " --map " + At("map.json"));
  };
  ExpectRefused(mapped(R"({"bones": {"tail": "x"}})"), "map.json:bones.tail: is none of pelvis, ");
  ExpectRefused(mapped(R"({"bones": {"left_hip": "x"}})"), "\"x\" is none of its nodes");
  ExpectRefused(mapped(R"({"bones": {"left_hip": 99}})"), "must be a name or a number below 26");
  ExpectRefused(mapped(R"({"bones": {"left_hip": -1}})"), "must be a node's name");
  ExpectRefused(mapped(R"({"bones": {"left_hip": null}})"), "none of them is the left_hip");
  ExpectRefused(mapped(R"({"bones": {"left_hip": "mixamorig:LeftLeg"}})"), "are one node");
  ExpectRefused(mapped(R"({"bones": 3})"), "must be an object");
  ExpectRefused(mapped(R"({"joints": {}})"), "joints");
  EXPECT_EQ(mapped(R"({"bones": {"left_foot": null, "spine3": 9}})").code, 0);
}

TEST_F(CharacterCommandTest, NamesImpossibleRequests) {
  WriteCharacter(folder_ / "hero.glb", {});
  std::filesystem::copy(folder_ / "hero.glb", folder_ / "hero.gltf");
  std::ofstream(folder_ / "empty.glb");
  std::ofstream(folder_ / "map.json") << "{}";
  const std::string hero = "--character " + At("hero.glb");
  ExpectRefused(Convert("--map " + At("map.json")), "map.json:bones: must be an object");
  ExpectRefused(Convert("--character " + At("hero.gltf")), "must be .glb");
  ExpectRefused(Convert("--character " + At("empty.glb")), "is not a binary glTF: bad header");
  ExpectRefused(Convert(hero, "out.npz"), "--character: is written to a .glb");
  ExpectRefused(Convert(hero, "hero.glb"), "is the file that --character is read from");
  ExpectRefused(Convert(hero + " --names ue"), "--names: is for a .bvh");
}

}  // namespace choreo::character_command_test
