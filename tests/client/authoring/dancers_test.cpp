#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <regex>

#include "client/authoring/fields/counts.h"
#include "client/authoring/keys/pose_library.h"
#include "client/authoring/project/formation.h"
#include "model/core/files/atomic_file.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/mirror.h"
#include "tests/client/stage_fixture.h"
#include "tests/support/expect_error.h"
#include "tests/support/glb_parts.h"

/// `choreo dance --dancers`, and pictures of all of them.
namespace choreo::dancers_test {

using testing::HasSubstr;
using testing::Not;

const Skeleton& Body() { return Skeleton::Smpl24(); }

class DancersTest : public StageTest {
 protected:
  void Write(const std::string& dancers, const std::string& more = "") const {
    std::ofstream(folder_ / "dancers.json") << "{\"dancers\": [" << dancers << "]" << more << "}";
  }
  Outcome DanceAll(const std::string& arguments = "") const {
    return Dance("stage", "--seed 3 --dancers " + At("dancers.json") + ' ' + arguments);
  }
};

double Apart(const Motion& a, const Motion& b) {
  return LeastDistance({Body(), a}, {Body(), b}).metres;
}

TEST_F(DancersTest, SingleDancerEqualsASoloDance) {
  ASSERT_EQ(Dance("alone", "--seed 3").code, 0);
  Write(R"({"id": "ada", "place": [0, 0]}, {"id": "ben", "place": [50, 10], "facing": 90})");
  const Outcome outcome = DanceAll();
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("ada, ben:\n300 frames"));
  const Motion alone = Read("alone.npz"), ada = Read("stage.ada.npz"), ben = Read("stage.ben.npz");
  const GroundFrame place{.origin = {50, 0, 10}, .heading = M_PI / 2};
  ASSERT_EQ(ada.frames.size(), alone.frames.size());
  for (size_t i = 0; i < alone.frames.size(); ++i) {
    EXPECT_LT(ComparePoses(Body(), ada.frames[i], alone.frames[i]).position_m, 1e-6);
    const Pose moved = place.ToWorld(alone.frames[i]);
    EXPECT_LT(ComparePoses(Body(), ben.frames[i], moved).position_m, 1e-5);
  }
  EXPECT_EQ(ReadJson(folder_ / "stage.ben.json")["keyframes"],
            ReadJson(folder_ / "alone.json")["keyframes"]);
}

TEST_F(DancersTest, ANoteNamesThoseWhomItIsAbout) {
  std::ofstream(folder_ / "jump.json")
      << R"({"keyframes": [{"id": "up", "time": 2, "pose": "star_jump"}]})";
  const auto count = [](const std::string& said, const std::string& what) {
    size_t found = 0;
    for (size_t at = said.find(what); at != said.npos; at = said.find(what, at + 1)) ++found;
    return found;
  };
  const std::string lost = "2 s (frame 60): key \"up\": the pose is ";
  // Two dances through the same keys, then keys of one dancer alone.
  Write(R"({"id": "ada", "place": [-1, 0]}, {"id": "ben", "place": [1, 0], "seed": 5})");
  const Outcome all = DanceAll("-k " + At("jump.json"));
  ASSERT_EQ(all.code, 0) << all.said;
  EXPECT_EQ(count(all.said, "warning: " + lost), 1U) << all.said;
  EXPECT_EQ(count(all.said, lost), 1U) << all.said;
  Write(R"({"id": "ada", "place": [-1, 0]},
           {"id": "ben", "place": [1, 0], "keyframes": ["jump.json"]},
           {"id": "cy", "place": [3, 0], "keyframes": ["jump.json"]})");
  const Outcome two = DanceAll("-k none");
  ASSERT_EQ(two.code, 0) << two.said;
  EXPECT_EQ(count(two.said, "warning: ben, cy: " + lost), 1U) << two.said;
  EXPECT_EQ(count(two.said, lost), 1U) << two.said;
}

TEST_F(DancersTest, WhoBeginsLaterEndsInHerOwnTime) {
  Write(R"({"id": "ada", "place": [0, 0]}, {"id": "cy", "place": [-4, 0], "after": "4 counts"})");
  const Outcome outcome = DanceAll("--end bow");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  PoseMask mask;
  mask.root_position = false;
  for (const std::string id : {"ada", "cy"}) {
    const nlohmann::json keys = ReadJson(folder_ / ("stage." + id + ".json"))["keyframes"];
    EXPECT_EQ(keys.back()["frame"], 299) << id;
    EXPECT_EQ(keys.back().value("holds", ""), "end-bow") << id;
    const Pose& last = Read("stage." + id + ".npz").frames.back();
    EXPECT_LT(ComparePoses(Body(), last, authoring::FindLibraryPose("bow").pose, mask).angle_deg,
              0.1)
        << id;
  }
}

TEST_F(DancersTest, MirroredInCanonAndApart) {
  Write(R"({"id": "ada", "place": [0, 0]}, {"id": "ben", "place": [0.3, 0], "mirrored": true},
           {"id": "cy", "place": [-0.3, 0], "after": "4 counts"},
           {"id": "dee", "place": [0, -0.3], "seed": 9})");
  const Outcome outcome = DanceAll();
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("ada, ben, cy:\n"));
  EXPECT_THAT(outcome.said, HasSubstr("dee:\n"));
  std::vector<Motion> danced;
  for (const char* id : {"ada", "ben", "cy", "dee"})
    danced.push_back(Read("stage." + std::string(id) + ".npz"));

  // The formation keeps its form, and nobody touches another.
  double least = 1e9;
  for (size_t i = 0; i < danced.size(); ++i) {
    EXPECT_EQ(danced[i].frames.size(), 300U);
    for (size_t j = 0; j < i; ++j) least = std::min(least, Apart(danced[i], danced[j]));
  }
  EXPECT_NEAR(least, 0.2, 0.005);
  std::smatch said;
  const std::string text = outcome.said;
  ASSERT_TRUE(
      std::regex_search(text, said, std::regex("least distance between bodies: ([0-9.]+)")));
  EXPECT_NEAR(std::stod(said[1]), least, 0.001);
  EXPECT_TRUE(std::regex_search(
      text, std::regex("note: places are [0-9.]+ times as far from their middle as requested, so "
                       "that bodies stay 0.2 m apart: [a-z]+ and [a-z]+ would come to -?[0-9.]+ m "
                       "at [0-9.]+ s\n")))
      << text;

  // Mirroring is about the dancer's place.
  const auto own = [](const Motion& motion, size_t frame) {
    Pose pose = motion.frames[frame];
    pose.root_position -= motion.frames[0].root_position;
    return pose;
  };
  // 4 counts are two seconds.
  std::vector<size_t> late;
  for (size_t delay = 58; delay <= 62; ++delay) {
    if (ComparePoses(Body(), own(danced[2], 200), own(danced[0], 200 - delay)).position_m < 1e-6)
      late.push_back(delay);
  }
  ASSERT_EQ(late.size(), 1U);
  for (const size_t frame : {20, 150, 299}) {
    const Pose mirrored = Mirror(Body(), own(danced[0], frame));
    EXPECT_LT(ComparePoses(Body(), own(danced[1], frame), mirrored).position_m, 1e-6);
    const Pose before = own(danced[0], frame < late[0] ? 0 : frame - late[0]);
    EXPECT_LT(ComparePoses(Body(), own(danced[2], frame), before).position_m, 1e-6);
  }
  const auto keys = ReadJson(folder_ / "stage.ada.json")["keyframes"];
  const auto later = ReadJson(folder_ / "stage.cy.json")["keyframes"];
  EXPECT_EQ(later[1]["frame"], keys[1]["frame"].get<size_t>() + late[0]);
  EXPECT_LE(later.size(), keys.size());
}

TEST_F(DancersTest, StayAtTheirPlacesIfNoDistanceIsAsked) {
  Write(R"({"id": "ada", "place": [0, 0]}, {"id": "ben", "place": [0.3, 0]})", R"(, "apart": 0)");
  const Outcome outcome = DanceAll();
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_TRUE(std::regex_search(outcome.said,
                                std::regex("warning: ada and ben reach [0-9.]+ m into each other "
                                           "at [0-9.]+ s: \"apart\": 0 keeps their places\n")))
      << outcome.said;
  EXPECT_THAT(outcome.said, Not(HasSubstr("note: places are")));
  const Eigen::Vector3d way =
      Read("stage.ben.npz").frames[0].root_position - Read("stage.ada.npz").frames[0].root_position;
  EXPECT_LT((way - Eigen::Vector3d(0.3, 0, 0)).norm(), 1e-5);
}

TEST_F(DancersTest, AreInOneFileAndOnOnePicture) {
  Write(R"({"id": "ada", "place": [-1, 0]}, {"place": [1, 0], "style": "", "mirrored": true})");
  EXPECT_THAT(DanceAll().said, HasSubstr("dancers.json:dancers[1].style: \"\" is not a text"));
  Write(R"({"id": "ada", "place": [-1, 0]}, {"place": [1, 0], "mirrored": true})");
  Outcome outcome = DanceAll("--seconds 4");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  outcome = Choreo("dance " + At("song.wav") + Server() + "--seed 3 --seconds 4 --dancers " +
                   At("dancers.json") + " -o " + At("all.glb"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const testing_support::Glb glb(folder_ / "all.glb");
  EXPECT_EQ(glb.document["skins"].size(), 2U);
  EXPECT_EQ(glb.document["meshes"].size(), 1U);
  EXPECT_EQ(glb.document["animations"].size(), 1U);
  EXPECT_EQ(glb.document["animations"][0]["channels"].size(), 2U * 25);
  EXPECT_EQ(glb.document["nodes"][25]["name"], "dancer2:pelvis");
  EXPECT_LT(
      ComparePoses(Body(), Read("all.glb").frames[50], Read("stage.ada.npz").frames[50]).position_m,
      0.05);

  const std::string two = At("stage.ada.npz") + ' ' + At("stage.dancer2.npz");
  outcome = Choreo("render " + two + " --frames 4 -o " + At("two.png"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  outcome = Choreo("render " + At("stage.ada.npz") + " --frames 4 -o " + At("one.png"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_GT(std::filesystem::file_size(folder_ / "two.png"),
            std::filesystem::file_size(folder_ / "one.png"));
  outcome = Choreo("render " + two + " -o " + At("stage.dancer2.npz"));
  EXPECT_NE(outcome.code, 0);
}

// A project and --dancers have one format.
TEST_F(DancersTest, ReadAProject) {
  const std::string all = R"("apart": 0.3, "dancers": [{"id": "ada", "place": [-1, 0]},
      {"id": "ben", "place": [1, 0], "mirrored": true, "after": "2 counts"}])";
  std::ofstream(folder_ / "p.json")
      << R"({"studio": 1, "song": "song.wav", "seed": 3, )" << all
      << R"(, "keyframes": [{"id": "k", "time": 2, "pose": "kick"}]})";
  std::ofstream(folder_ / "dancers.json") << "{" << all << "}";
  const auto dance = [&](const std::string& more, const std::string& out) {
    const Outcome outcome =
        Choreo("dance" + Server() + "--project " + At("p.json") + more + " -o " + At(out));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
  };
  dance("", "own.npz");
  dance(" --dancers " + At("p.json"), "named.npz");
  dance(" --dancers " + At("dancers.json"), "apart.npz");
  for (const char* id : {"ada", "ben"}) {
    const auto bytes = [&](const std::string& name) {
      return ReadFile(folder_ / (name + "." + id + ".npz"));
    };
    EXPECT_EQ(bytes("own"), bytes("apart")) << id;
    EXPECT_EQ(bytes("named"), bytes("apart")) << id;
  }
  const Outcome shown = Choreo("dance" + Server() + "--project " + At("p.json") +
                               " --vmc 127.0.0.1:39539 -o " + At("x.npz"));
  EXPECT_THAT(shown.said, HasSubstr("--vmc: shows one dancer"));
}

TEST_F(DancersTest, HaveKeysInTheirOwnFileOrBesideTheirPlace) {
  const std::string key =
      R"({"id": "ks", "time": 2, "pose": "kick", "place": [0, 0], "hands": "fist"})";
  std::ofstream(folder_ / "ben.json") << R"({"keyframes": [)" << key << "]}";
  Write(R"({"id": "ada", "place": [-2, 0]}, {"id": "ben", "place": [0, 0], "keyframes": "ben.json"},
           {"id": "cy", "place": [2, 0], "keyframes": [)" +
        key + "]}");
  const Outcome outcome = DanceAll("--seconds 4");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const nlohmann::json ben = ReadJson(folder_ / "stage.ben.json")["keyframes"];
  ASSERT_EQ(ben.size(), 1U);
  EXPECT_EQ(ben[0]["hands"], "fist");
  EXPECT_EQ(ReadJson(folder_ / "stage.cy.json")["keyframes"], ben);
  EXPECT_NE(ReadJson(folder_ / "stage.ada.json")["keyframes"], ben);
  Write(R"({"id": "cy", "place": [2, 0], "keyframes": [{"time": 1, "pose": "kik"}]})");
  EXPECT_THAT(DanceAll("--seconds 4").said,
              HasSubstr("dancers.json:dancers[0]:keyframes[0].pose: "));
}

TEST_F(DancersTest, AreAllCheckedBeforeTheFirstDances) {
  const auto refused = [this](const std::string& ben, const std::string& part) {
    Write(R"({"id": "ada", "place": [0, 0]}, {"id": "ben", "place": [2, 0], )" + ben + "}");
    const Outcome outcome = DanceAll();
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.said, HasSubstr(part));
    EXPECT_THAT(outcome.said, Not(HasSubstr("dancing")));
  };
  refused(
      R"("keyframes": [{"time": 15, "pose": "kick"}])",
      "dancers.json:dancers[1]:keyframes[0].time: key \"key1\" at 15 s is after the dance's end");
  refused(R"("after": 10)", "dancers[1].after: 10 s later is after the end");
}

TEST_F(DancersTest, RefuseImpossibleRequests) {
  const auto expect_failure = [this](const std::string& dancers, const std::string& part,
                                     const std::string& more = "") {
    Write(dancers, more);
    const Outcome outcome = DanceAll();
    EXPECT_EQ(outcome.code, 1) << dancers;
    EXPECT_THAT(outcome.said, HasSubstr(part));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "stage.ada.npz"));
  };
  const std::string ada = R"({"id": "ada", "place": [0, 0]})";
  expect_failure("", "dancers.json:dancers");
  expect_failure(ada + R"(, {"place": [0, 0]})", "dancers[1].place: [0,0] is where ada stands");
  expect_failure(ada + "," + R"({"id": "ada", "place": [1, 0]})", "dancers[1].id: \"ada\" is an");
  expect_failure(R"({"id": "../ada", "place": [0, 0]})", "has more than letters, digits, _ and -");
  expect_failure(R"({"id": "ada"})", "dancers[0].place: is missing: [x, z]");
  expect_failure(R"({"place": [0, 0, 1]})", "dancers[0].place: [0,0,1] is not a place");
  expect_failure(R"({"place": [0, 0], "turn": 3})", "dancers[0].turn");
  expect_failure(R"({"place": [0, 0], "facing": 400})", "is not a number from -360 to 360");
  expect_failure(R"({"place": [0, 0], "after": "soon"})", "dancers[0].after: \"soon\" is neither");
  expect_failure(R"({"place": [0, 0], "after": 10})",
                 "dancers[0].after: 10 s later is after the end");
  expect_failure(R"({"place": [0, 0], "seed": -1})", "dancers[0].seed: -1 is not a whole number");
  expect_failure(ada, "apart: 11 is not a number from 0 to 10", R"(, "apart": 11)");
  EXPECT_NE(DanceAll("--vmc 127.0.0.1:39539").code, 0);
}

TEST(FormationTest, DancersFaceThoseWhomTheyName) {
  const auto read = [](const std::string& ben) {
    const std::string text = R"({"dancers": [{"id": "ada", "place": [0, 1], "facing": "ben"},
                                {"id": "ben", "place": [2, 1], "facing": )" +
                             ben + "}]}";
    return authoring::ParseDancers(nlohmann::json::parse(text), "d.json", "");
  };
  const authoring::Dancers both = read("\"ada\"");
  EXPECT_NEAR(both.dancers[0].facing, 90, 1e-9);
  EXPECT_NEAR(both.dancers[1].facing, -90, 1e-9);
  for (const char* nobody : {"\"ben\"", "\"cy\""}) {
    ExpectError(
        ErrorCode::kInvalidArgument,
        std::string("d.json:dancers[1].facing: ") + nobody + " is none of the other dancers",
        [&] { read(nobody); });
  }
}

TEST(FormationTest, IsWidenedAsFarAsNeeded) {
  Motion stands{.fps = 30, .frames = std::vector<Pose>(3, RestPose(Body()))};
  std::vector<MovingBody> bodies;
  const std::vector<Eigen::Vector3d> places = {{-0.5, 0, 0}, {0.5, 0, 0}};
  for (const Eigen::Vector3d& place : places) {
    Motion there = stands;
    for (Pose& pose : there.frames) pose.root_position += place;
    bodies.emplace_back(Body(), there);
  }
  // With arms held out they reach into each other.
  EXPECT_LT(authoring::FindNearest(bodies, authoring::MovesOf(places, 1)).distance.metres, 0);
  const double factor = authoring::WidenFormation(bodies, places, 0.3);
  EXPECT_GT(factor, 1.5);
  EXPECT_NEAR(authoring::FindNearest(bodies, authoring::MovesOf(places, factor)).distance.metres,
              0.3, 0.002);
}

TEST(CountsTest, ContinueAtTheirTempo) {
  const authoring::Counts counts{{1, 1.5, 2, 3}};
  const auto after = [&](const std::string& text, double seconds) {
    return authoring::ParseTime(text, "x").After(seconds, counts, "x");
  };
  EXPECT_DOUBLE_EQ(after("2.5", 1), 3.5);
  EXPECT_DOUBLE_EQ(after("2.5 s", 1), 3.5);
  EXPECT_DOUBLE_EQ(after("2c", 1), 2);
  EXPECT_DOUBLE_EQ(after("2 counts", 1.25), 2.5);
  EXPECT_DOUBLE_EQ(after("1 count", 0), 0.5);
  EXPECT_DOUBLE_EQ(after("2c", 2), 4);
  EXPECT_DOUBLE_EQ(after("1c", 3.5), 4.5);
  for (const char* wrong : {"", "c", "2 bars", "-1c", "1e99", "nan"}) {
    ExpectError(ErrorCode::kInvalidArgument, "x: ", [&] { authoring::ParseTime(wrong, "x"); });
  }
  ExpectError(ErrorCode::kInvalidArgument, "counts need music",
              [] { authoring::ParseTime("2c", "x").After(0, {}, "x"); });
}

TEST(CountsTest, NameMomentsAsTheRulerDoes) {
  const std::vector<double> beats = {1, 1.5, 2, 3}, ones = {1.5};
  const authoring::Counts counts = authoring::CountsFrom(beats, ones);
  const auto at = [&](const std::string& text) {
    return authoring::ParseTime(text, "x").In(counts, "x");
  };
  EXPECT_DOUBLE_EQ(at("1c"), 1.5);
  EXPECT_DOUBLE_EQ(at("2.5 counts"), 2.5);
  EXPECT_DOUBLE_EQ(at("5c"), 5);
  EXPECT_DOUBLE_EQ(at("0c"), 1);
  EXPECT_DOUBLE_EQ(at("2.5"), 2.5);
  EXPECT_EQ(authoring::CountsFrom(beats, {}).one, 0U);
  ExpectError(ErrorCode::kInvalidArgument, "x: 0c is before second 0; count 1 is at 0.3 s", [] {
    const std::vector<double> soon = {0.3, 0.8}, one = {0.3};
    authoring::ParseTime("0c", "x").In(authoring::CountsFrom(soon, one), "x");
  });
}

}  // namespace choreo::dancers_test
