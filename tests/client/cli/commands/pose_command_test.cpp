#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_file.h"
#include "client/authoring/keys/pose_library.h"
#include "client/authoring/keys/pose_source.h"
#include "client/cli/commands/pose_recipe.h"
#include "model/body/doll.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/run_choreo.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::cli::pose_command_test {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

class PoseCommandTest : public testing::Test {
 protected:
  std::string At(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  Pose Read(const std::string& name) const {
    return authoring::ReadPose((folder_ / name).string(), Body()).key.pose;
  }
  TemporaryFolder folder_;
};

TEST_F(PoseCommandTest, WritesAKeyAndAPicture) {
  const Outcome outcome = Choreo(
      "pose --from kick --set left_elbow=90 --reach right_hand=0.3,1.6,0.2 --mirror "
      "--ground --out " +
      At("p.json") + " --png " + At("out.png"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_EQ(outcome.said,
            (folder_ / "p.json").string() + '\n' + (folder_ / "out.png").string() + '\n');
  EXPECT_GT(std::filesystem::file_size(folder_ / "out.png"), 10'000U);
  const Pose pose = Read("p.json");
  const Eigen::Matrix3Xd joints = JointPositions(Body(), pose);
  // Mirrored: the hand that was drawn is the left one, SMPL's sides differ by millimetres.
  EXPECT_LT((joints.col(Body().Find("left_hand")) - Eigen::Vector3d(-0.3, 1.6, 0.2)).norm(), 0.03);
  EXPECT_NEAR(DollAboveFloor(Body(), pose), 0, 0.02);
  const Hinge elbow = Hinges(Body())[3];
  EXPECT_NEAR(elbow.axis.dot(pose.rotations.col(elbow.joint)), M_PI / 2, 0.3);
}

TEST_F(PoseCommandTest, OutputIsAValidKey) {
  ASSERT_EQ(Choreo("pose --from groove --at 2.5 --description 'Low \"and\" loose' --tag standing "
                   "--out " +
                   At("mine.json"))
                .code,
            0);
  const std::string path = (folder_ / "mine.json").string();
  const authoring::DescribedPose read =
      authoring::ParsePoseFile(authoring::ReadText(path, "pose"), path, Body());
  EXPECT_EQ(read.key.id, "mine");
  EXPECT_EQ(read.key.time_s, 2.5);
  EXPECT_EQ(read.description, "Low \"and\" loose");
  EXPECT_EQ(read.tags, std::vector<std::string>{"standing"});
  EXPECT_LT(
      ComparePoses(Body(), read.key.pose, authoring::FindLibraryPose("groove").pose).position_m,
      1e-3);
  EXPECT_EQ(authoring::PoseFileText(read, Body()), authoring::ReadText(path, "pose"));
}

TEST_F(PoseCommandTest, AKeySaysHowLongItIsHeldAndHowHardItIsHit) {
  ASSERT_EQ(Choreo("pose --from dab --at 2 --hold 0.8 --hit 2.5 --out " + At("a.json")).code, 0);
  const auto expect_held = [this](const std::string& name, double at_s) {
    std::vector<std::string> places;
    const auto keys = authoring::ReadKeys((folder_ / name).string(), Body(), &places);
    ASSERT_EQ(keys.size(), 5U);
    EXPECT_EQ(keys.front().time_s, at_s);
    EXPECT_EQ(keys.front().hit, 2.5);
    EXPECT_NEAR(keys.back().time_s, at_s + 0.8, 1e-9);
    EXPECT_TRUE(authoring::IsHeld(places.back()));
  };
  expect_held("a.json", 2);
  // A pose made from it keeps both, at any time.
  for (const char* at : {"0", "2", "4.5"}) {
    const std::string from = "pose --from " + At("a.json") + " --mirror --out " + At("b.json");
    ASSERT_EQ(Choreo(from + " --at " + at).code, 0);
    expect_held("b.json", std::stod(at));
  }
  const Outcome jump = Choreo("pose --from star_jump --hold 3 --out " + At("c.json"));
  EXPECT_EQ(jump.code, 1);
  EXPECT_THAT(jump.said, HasSubstr("--hold: key"));
  EXPECT_THAT(Choreo("pose --hold 70 --out " + At("c.json")).said, HasSubstr("--hold: "));
  EXPECT_THAT(Choreo("pose --hit 2").said, HasSubstr("--hit requires --out"));
}

TEST_F(PoseCommandTest, PlacesAndTurnsThePose) {
  ASSERT_EQ(Choreo("pose --from kick --place -1,2 --facing 90 --out " + At("a.json")).code, 0);
  const GroundFrame placed{.origin = {-1, 0, 2}, .heading = M_PI / 2};
  const Pose kick = authoring::FindLibraryPose("kick").pose;
  EXPECT_LT(ComparePoses(Body(), Read("a.json"), placed.ToWorld(kick)).position_m, 1e-3);

  // One's own pose is where its hips are.
  ASSERT_EQ(
      Choreo("pose --from " + At("a.json") + " --place 0,0.5 --facing -45 --out " + At("b.json"))
          .code,
      0);
  const GroundFrame own = GroundFrame::Of(Read("b.json"));
  EXPECT_LT((own.origin - Eigen::Vector3d(0, 0, 0.5)).norm(), 1e-3);
  EXPECT_NEAR(own.heading, -M_PI / 4, 1e-3);
  EXPECT_NEAR(Read("b.json").root_position.y(), kick.root_position.y(), 1e-3);
  EXPECT_THAT(Choreo("pose --place 1 --out " + At("c.json")).said,
              HasSubstr("--place: \"1\" is not X,Z, metres"));
}

TEST_F(PoseCommandTest, KnowsNoSongWhoseCountsItCouldRead) {
  EXPECT_THAT(Choreo("pose --at 9c --out " + At("a.json")).said,
              HasSubstr("--at: 9c is a count, and pose knows no song: say seconds"));
  WriteMotion(folder_ / "d.npz", Body(), {.fps = 30, .frames = {RestPose(Body())}});
  EXPECT_THAT(Choreo("pose --from " + At("d.npz") + "@16c").said,
              HasSubstr("\"16c\" is a count, and a motion knows no song: say seconds"));
}

TEST_F(PoseCommandTest, WritesWhatHandsDoAndKeepsWhatAKeyFileSays) {
  const auto key_of = [&](const std::string& name, const std::string& arguments) {
    EXPECT_EQ(Choreo("pose " + arguments + " --out " + At(name)).code, 0) << arguments;
    return authoring::ReadPose((folder_ / name).string(), Body()).key;
  };
  EXPECT_EQ(key_of("fist.json", "--from kick --hands fist").hands, HandPose::kFist);
  EXPECT_EQ(key_of("kick.json", "--from kick").hands, std::nullopt);
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [
    {"id": "hit", "time": 1, "pose": "kick", "hit": 2, "hands": "point"}]})";
  const client::KeyPose kept = key_of("kept.json", "--mirror --from " + At("keys.json@hit"));
  EXPECT_EQ(kept.hands, HandPose::kPoint);
  EXPECT_EQ(kept.hit, 2);
  EXPECT_EQ(Choreo("pose --hands paw").code, 2);
}

TEST_F(PoseCommandTest, PrintsJointsInDegrees) {
  const Outcome outcome = Choreo("pose --set left_elbow=90 --set neck=-10,20,5");
  EXPECT_THAT(outcome.said, HasSubstr("left_elbow=90\n"));
  EXPECT_THAT(outcome.said, HasSubstr("neck=-10,20,5\n"));
  EXPECT_THAT(outcome.said, HasSubstr("head=0,0,0\n"));
}

TEST_F(PoseCommandTest, ListsTheLibraryByTag) {
  const Outcome all = Choreo("pose --list --png " + At("all.png"));
  EXPECT_EQ(all.code, 0);
  for (const authoring::LibraryPose& pose : authoring::PoseLibrary())
    EXPECT_THAT(all.said, HasSubstr(pose.id));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "all.png"));
  const Outcome none = Choreo("pose --list --tag flying");
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.said, HasSubstr("no pose of the library is flying; tags are standing, "));
}

TEST_F(PoseCommandTest, ErrorsNameTheOptionTheValueAndTheLimit) {
  const auto refused = [](const PoseRecipe& recipe, const std::string& part) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { MakePose(recipe, Body()); });
  };
  const auto set = [](const std::string& text) {
    PoseRecipe recipe;
    recipe.set = {text};
    return recipe;
  };
  const auto reach = [](const std::vector<std::string>& texts) {
    PoseRecipe recipe;
    recipe.reach = texts;
    return recipe;
  };
  refused(set("left_elbow=200"),
          "--set left_elbow=200: left_elbow is at 200 degrees, must be 0 to 165");
  refused(set("left_elbow"), "--set left_elbow: has no =, as in left_elbow=90");
  refused(set("left_elbow=x"), "--set left_elbow=x: \"x\" is not a number");
  refused(set("elbow_left=20"),
          "\"elbow_left\" is not a joint of smpl24; did you mean left_elbow?");
  refused(set("left_elbw=20"), "did you mean left_elbow?");
  refused(set("tail=1"), "--set tail=1: \"tail\" is not a joint of smpl24, which has pelvis");
  refused(reach({"head=1,2"}), "--reach head=1,2: takes three numbers, metres along x, y and z");
  refused(reach({"head=0,1,0", "head=0,1,0"}), "this joint has a target already");
  refused(reach({"right_hand=0,4,0"}),
          "--reach right_hand=0,4,0: is out of reach: right_hand ended");
}

TEST_F(PoseCommandTest, FootHeightIsMeasuredAtTheSole) {
  PoseRecipe recipe;
  recipe.reach = {"left_foot=0.4,0,0.2"};
  const Pose pose = MakePose(recipe, Body()).key.pose;
  EXPECT_NEAR(DollAboveFloor(Body(), pose), 0, 0.01);
}

TEST_F(PoseCommandTest, WarnsOfImpossiblePoses) {
  ASSERT_EQ(Choreo("pose --reach pelvis=0,0.5,0 --out " + At("low.json")).code, 0);
  const Outcome outcome = Choreo("pose --from " + At("low.json") +
                                 " --set left_knee=0 --set right_knee=0 --set left_hip=0,0,0 "
                                 "--set right_hip=0,0,0");
  EXPECT_THAT(outcome.said, HasSubstr("warning: right_"));
  EXPECT_THAT(outcome.said, HasSubstr("cm under the floor"));
}

TEST_F(PoseCommandTest, MirrorsTheMaskToo) {
  std::ofstream(folder_ / "arm.json") << R"({"keyframes": [{"time": 1, "joints": ["left_elbow"],
    "rotations": [[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],
    [0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,-1,0],[0,0,0],[0,0,0],
    [0,0,0],[0,0,0],[0,0,0]]}]})";
  PoseRecipe recipe;
  recipe.from = (folder_ / "arm.json").string();
  recipe.mirror = true;
  const client::KeyPose key = MakePose(recipe, Body()).key;
  EXPECT_TRUE(key.mask.Constrains(Body().right_elbow));
  EXPECT_FALSE(key.mask.Constrains(Body().left_elbow));
  EXPECT_NEAR(key.pose.rotations(1, Body().right_elbow), 1, 1e-12);
}

}  // namespace choreo::cli::pose_command_test
