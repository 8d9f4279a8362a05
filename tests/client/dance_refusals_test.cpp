#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"

namespace choreo::dance_refusals_test {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

TEST_F(CommandTest, WarnsOfKeysThatNoBodyCouldDance) {
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [
    {"id": "a", "time": 1, "pose": "star_jump", "place": [0, 0]},
    {"id": "up", "time": 3, "pose": "star_jump", "place": [0, 0]}]})";
  const Outcome outcome = Choreo("dance -k " + At("keys.json") + Server() + "-o " + At("d.npz") +
                                 " --report " + At("r.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const std::string fault =
      "keyframes[1]): the body would be in the air for 2 s, since \"a\"; a jump takes 1";
  EXPECT_THAT(outcome.said, HasSubstr("warning: 3 s (frame 90): key \"up\" ("));
  EXPECT_THAT(outcome.said, HasSubstr(fault));
  EXPECT_THAT(ReadJson(folder_ / "r.json")["warnings"].dump(),
              HasSubstr("the body would be in the air"));
}

TEST_F(CommandTest, NoPoseIsHeldInTheAir) {
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [
    {"id": "a", "time": 1, "pose": "tuck_jump", "place": [0, 0], "hold": 1}]})";
  const auto refused = [&](const std::string& arguments, const std::string& field,
                           const std::string& key) {
    const Outcome outcome = Choreo(arguments + Server() + " -o " + At("e.npz"));
    EXPECT_EQ(outcome.code, 1) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr(field + ": key \"" + key + "\""));
    EXPECT_THAT(outcome.said, HasSubstr(" m in the air, where a jump keeps it for 0."));
    EXPECT_THAT(outcome.said, HasSubstr("; hold the landing instead\n"));
  };
  refused("dance --seconds 8 --end star_jump", "--end", "star_jump");
  refused("dance --seconds 8 -k " + At("keys.json"), "keys.json:keyframes[0].hold", "a");
  ASSERT_EQ(Choreo("dance --seconds 8 -o " + At("d.npz") + Server()).code, 0);
  refused("edit " + At("d.npz") + " --end star_jump", "--end", "star_jump");
  refused("edit " + At("d.npz") + " --key tuck_jump --at 3 --hold 1", "--hold", "tuck_jump");
  const std::string brief = " --key tuck_jump --at 3 --hold 0.2 -o ";
  EXPECT_EQ(Choreo("edit " + At("d.npz") + brief + At("e.npz") + Server()).code, 0);
  const std::string landing = " --key bow --at 3 --hold 1 -o ";
  EXPECT_EQ(Choreo("edit " + At("d.npz") + landing + At("e.npz") + Server()).code, 0);
}

TEST_F(CommandTest, APoseOfTheLibraryIsNoKeyFile) {
  const Outcome outcome = Choreo("dance --seconds 4 --keyframes kick -o " + At("d.npz") + Server());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("kick: is a pose of the library, not a file: a key file"));
}

TEST_F(CommandTest, WarnsOnceOfAPoseThatIsHeld) {
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [
    {"id": "a", "time": 1, "rotations": )"
                                       << nlohmann::json(std::vector(24, std::vector(3, 0.0)))
                                       << R"(, "root_position": [0, 0.4, 0], "hold": 1}]})";
  const Outcome outcome = Choreo("dance -k " + At("keys.json") + Server() + "-o " + At("d.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const size_t first = outcome.said.find("cm under the floor");
  EXPECT_NE(first, std::string::npos) << outcome.said;
  EXPECT_EQ(outcome.said.find("cm under the floor", first + 1), std::string::npos) << outcome.said;
}

TEST_F(CommandTest, RefusesKneesThatBendBackwardsUnlessToldOtherwise) {
  ASSERT_EQ(Choreo("dance --seconds 4 -o " + At("d.npz") + Server()).code, 0);
  nlohmann::json rotations(std::vector(24, std::vector(3, 0.0)));
  rotations[4] = {-0.7, 0, 0};
  const nlohmann::json key = {{"id", "bent"}, {"time", 2}, {"rotations", rotations}};
  std::ofstream(folder_ / "keys.json") << nlohmann::json{{"keyframes", {key}}};
  for (const std::string& command :
       {"dance --seconds 4 -k " + At("keys.json"),
        "edit " + At("d.npz") + " --at 2 --in-place --key " + At("keys.json")}) {
    const Outcome refused = Choreo(command + Server() + "-o " + At("e.npz"));
    EXPECT_EQ(refused.code, 1) << refused.said;
    EXPECT_THAT(refused.said, HasSubstr("keys.json"));
    EXPECT_THAT(refused.said, HasSubstr("key \"bent\": left_knee bends 39.86 degrees backwards, "
                                        "further than 15; --allow-bends"));
    const Outcome taken = Choreo(command + " --allow-bends" + Server() + "-o " + At("e.npz"));
    EXPECT_EQ(taken.code, 0) << taken.said;
    EXPECT_THAT(taken.said, HasSubstr("warning: 2 s (frame 60): key \"bent\""));
  }
}

TEST_F(CommandTest, AnEditTakesOneKeyOfAFile) {
  ASSERT_EQ(Choreo("dance --seconds 4 -o " + At("d.npz") + Server()).code, 0);
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [
    {"id": "a", "time": 1, "pose": "stand"}, {"id": "b", "time": 2, "pose": "kick"}]})";
  const auto edit = [&](const std::string& key) {
    return Choreo("edit " + At("d.npz") + " --at 2 --in-place --key " + key + Server() + "-o " +
                  At("e.npz"));
  };
  const Outcome one = edit(At("keys.json") + "@b");
  EXPECT_EQ(one.code, 0) << one.said;
  EXPECT_THAT(one.said, HasSubstr("key b: frames"));
  const Outcome several = edit(At("keys.json"));
  EXPECT_EQ(several.code, 1);
  EXPECT_THAT(several.said, HasSubstr("keys.json: names 2 poses, must be 1: KEYS.json@ID"));
  EXPECT_THAT(edit(At("keys.json") + "@c").said,
              HasSubstr("keys.json: has no key \"c\"; it has a, b"));
}

TEST_F(CommandTest, AnEditWarnsOfAKeyThatNoBodyCouldDance) {
  ASSERT_EQ(Choreo("dance --seconds 4 -o " + At("d.npz") + Server()).code, 0);
  ASSERT_EQ(Choreo("pose --lift 0 --reach pelvis=0,0.5,0 --out " + At("low.json")).code, 0);
  ASSERT_EQ(Choreo("pose --from " + At("low.json") +
                   " --set left_knee=0 --set right_knee=0 "
                   "--set left_hip=0,0,0 --set right_hip=0,0,0 --out " +
                   At("sunk.json"))
                .code,
            0);
  const Outcome outcome = Choreo("edit " + At("d.npz") + " --key " + At("sunk.json") +
                                 " --at 2 -o " + At("e.npz") + Server());
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("warning: 2 s (frame 60): key \"sunk\": "));
  EXPECT_THAT(outcome.said, HasSubstr("cm under the floor"));
}

TEST_F(CommandTest, WritesReceivedFramesOfACutDance) {
  WriteClicks(folder_ / "song.wav", 8);
  TestServer breaking(std::make_unique<BreakingSampler>(200));
  const Outcome outcome =
      Choreo("dance --server " + breaking.address() + " " + At("song.wav") + " -o " + At("d.bvh"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("the dance was cut off"));
  EXPECT_THAT(outcome.said, HasSubstr("the device is gone"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "d.bvh"));
  const size_t frames = ReadMotion(folder_ / "d.partial.bvh", Body()).frames.size();
  EXPECT_GT(frames, 100U);
  EXPECT_LT(frames, 240U);
}

TEST_F(CommandTest, NamesAKeyAsItWasWritten) {
  WriteClicks(folder_ / "song.wav", 4);
  const auto write = [&](const std::string& name, const std::string& first,
                         const std::string& second) {
    const std::string pose = R"("root_position": [0, 1, 0], "rotations": )" +
                             nlohmann::json(std::vector(24, std::vector{0.0, 0.1, 0.0})).dump();
    std::ofstream(folder_ / name) << "{\"keyframes\": [{" << first << ", " << pose << "}, {"
                                  << second << ", " << pose << "}]}";
  };
  const auto refused = [&](const std::string& keys, const std::string& part) {
    const Outcome outcome = Choreo("dance " + keys + Server() + At("song.wav"));
    EXPECT_EQ(outcome.code, 1) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr(part));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "song.npz"));
  };
  // Keys are sent in the order of their times, so the server's keyframes[1] is the file's first.
  write("close.json", R"("id": "late", "frame": 61)", R"("id": "early", "frame": 60)");
  refused("-k " + At("close.json"), "close.json:keyframes[0]");
  refused("-k " + At("close.json"), "key \"late\"");
  write("beyond.json", R"("id": "a", "time": 1)", R"("id": "b", "time": 12)");
  refused("-k " + At("beyond.json"),
          "beyond.json:keyframes[1].time: key \"b\" at 12 s is after the dance's end: its last "
          "frame is at 3.97 s");
  // Keys that hold a pose are written as that pose's hold.
  write("held.json", R"("id": "a", "time": 1, "hold": 1)", R"("id": "b", "time": 12)");
  refused("-k " + At("held.json"), "held.json:keyframes[1].time: key \"b\" at 12 s is after");
  write("long.json", R"("id": "a", "time": 1)", R"("id": "b", "time": 2, "hold": 4)");
  refused(
      "-k " + At("long.json"),
      "long.json:keyframes[1].hold: the end of the hold of key \"b\" at 6 s is after the dance's "
      "end: its last frame is at 3.97 s");
  write("one.json", R"("id": "a", "time": 1)", R"("id": "b", "time": 2)");
  write("two.json", R"("id": "c", "time": 3)", R"("id": "a", "time": 3.5)");
  refused("-k " + At("one.json") + " -k " + At("two.json"),
          "two.json:keyframes[1].id: \"a\" stands for");
  refused("-k " + At(""), "is a folder, not a key file");
}

TEST_F(CommandTest, ChecksItsOutputsBeforeItDances) {
  WriteClicks(folder_ / "song.wav", 3);
  // There is no server: a command that tried to connect would fail with another error.
  const auto refused = [&](const std::string& arguments, const std::string& part) {
    const Outcome outcome = Choreo(arguments + " --deadline 0.3 --server 127.0.0.1:1");
    EXPECT_EQ(outcome.code, 1) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr(part));
  };
  const std::string dance = "dance " + At("song.wav");
  refused(dance + " -o /proc/o.npz", "--out: /proc/o.npz cannot be written");
  refused(dance + " --report /nonexistent/r.json", "--report: /nonexistent/r.json: no folder");
  refused(dance + " --report " + At(""), "is a folder");
  std::ofstream(folder_ / "song.npz") << "mine";
  refused(dance + " --no-clobber", "song.npz is there already");
  refused(dance, "127.0.0.1:1");
  std::ifstream kept(folder_ / "song.npz");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), "mine");
  const std::string transition = "transition --from kick --to groove";
  refused(transition + " -o /proc/o.npz", "--out: /proc/o.npz");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "t.npz"));
  refused(transition + " -o " + At("t.npz"), "127.0.0.1:1");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "t.npz"));
  refused(transition + " -o " + std::string(300, 'n') + ".npz", "cannot be written: File name too");
  const Outcome jpg = Choreo("render " + At("song.wav") + " --out " + At("s.jpg"));
  EXPECT_EQ(jpg.code, 1);
  EXPECT_THAT(jpg.said, HasSubstr("s.jpg does not end in .png"));
}

TEST_F(CommandTest, NoOutputDestroysAnotherOrAnInput) {
  WriteClicks(folder_ / "song.wav", 3);
  WriteMotion(folder_ / "d.npz", Body(), {.fps = 30, .frames = {RestPose(Body())}});
  std::filesystem::create_symlink("d.npz", folder_ / "link.npz");
  const auto read = [&](const std::string& name) {
    std::ifstream file(folder_ / name, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  const std::string song = read("song.wav"), motion = read("d.npz");
  const auto refused = [&](const std::string& arguments, const std::string& part) {
    const Outcome outcome = Choreo(arguments);
    EXPECT_EQ(outcome.code, 1) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr(part));
    EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said;
  };
  // There is no server: a command that tried to connect would fail with another error.
  const std::string server = " --server 127.0.0.1:1 --deadline 0.3 ";
  const std::string dance = "dance " + At("song.wav") + server;
  refused(dance + "-o " + At("x.npz") + " --report " + At("./x.npz"),
          "--report: " + (folder_ / "./x.npz").string() + " is the file that --out is written to");
  refused(dance + "--report " + At("song.wav"), "song.wav is the file that song is read from");
  refused(dance + "-k " + At("d.npz@0=1") + " -o " + At("link.npz"),
          "link.npz is the file that --keyframes is read from");
  refused(
      "edit " + At("d.npz") + server + "--loop -o " + At("e.npz") + " --new-report " + At("e.npz"),
      "--new-report: ");
  refused("edit " + At("d.npz") + server + "--loop -o " + At("d.npz"),
          "--out: " + (folder_ / "d.npz").string() + " is the file that dance is read from");
  const std::string transition = "transition --to groove" + server + "--from ";
  refused(transition + "kick --candidates 3 -o " + At("t.npz") + " --report " + At("t.3.npz"),
          "t.3.npz is the file that --report is written to");
  refused(transition + At("d.npz@0") + " -o " + At("d.npz"),
          "d.npz is the file that --from is read from");
  refused("convert " + At("d.npz") + " " + At("link.npz"), "the file that in is read from");
  refused("analyze " + At("song.wav") + " --features " + At("song.wav"), "song is read from");
  std::ofstream(folder_ / "s.png") << R"({"fps": 30, "keyframes": []})";
  refused("render " + At("d.npz") + " --out " + At("s.png") + " --report " + At("s.png"),
          "s.png is the file that --report is read from");
  EXPECT_EQ(read("song.wav"), song);
  EXPECT_EQ(read("d.npz"), motion);
}

TEST_F(CommandTest, RefusesInvalidNumbers) {
  WriteClicks(folder_ / "song.wav", 3);
  const auto refused = [&](const std::string& arguments, const std::string& part) {
    const Outcome outcome = Choreo(arguments + Server());
    EXPECT_EQ(outcome.code, 2) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr(part));
    EXPECT_THAT(outcome.said, testing::StartsWith("choreo: "));
    EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said;
    EXPECT_LT(outcome.said.size(), 200U) << outcome.said;
  };
  refused("dance --seconds 0 " + At("song.wav"), "0 is not a number above 0");
  refused("dance --seconds nan " + At("song.wav"), "nan is not a number above 0");
  refused("dance --seed -1 " + At("song.wav"), "-1 is not a whole number from 0");
  const std::string transition = "transition --from kick --to groove -o " + At("t.npz");
  refused(transition + " --at -1", "\"-1\" is neither seconds (2.5) nor counts (8c)");
  refused(transition + " --at 2", "--at: needs --song, --path or a file for --velocity");
  refused(transition + " --hit 3.1", "3.1 is not a number from 0 to 3");
  refused(transition + " -n 9999999999999", "is not a whole number from 1 to 2147483647");
  refused(transition + " -n 99999999999999999999999", "is not a whole number from 1 to 2147483647");
  refused(transition + " --candidates 33", "33 is not a whole number from 1 to 32");
  refused("dance --fps 0 " + At("song.wav"), "0 is not a number from 1 to 120");
  const Outcome brief = Choreo("dance --seconds 1e-9 " + At("song.wav") + Server());
  EXPECT_EQ(brief.code, 1);
  EXPECT_THAT(brief.said, HasSubstr("--seconds: 1e-09 s is shorter than 2 s, the least for"));
  const Outcome framed =
      Choreo("dance --seconds 0.01 -k '" SOURCE_FOLDER "/examples/keys.json'" + Server());
  EXPECT_EQ(framed.code, 1);
  EXPECT_THAT(framed.said, HasSubstr("--seconds: 0.01 s is shorter than a frame of the model, "
                                     "0.033 s, the least"));
  const Outcome long_one = Choreo("dance --seconds 1e8 -o " + At("t.npz") + Server());
  EXPECT_EQ(long_one.code, 1);
  EXPECT_THAT(long_one.said, HasSubstr("--seconds: 1e+08 s is beyond 3600 s, the longest dance"));
  const Outcome endless = Choreo(transition + " -n 2000" + Server());
  EXPECT_EQ(endless.code, 1);
  EXPECT_THAT(endless.said,
              HasSubstr("--frames: 2000 is not in [1, 1800], what the model \"fake\" can make"));
  const Outcome late = Choreo(transition + " --at 100 --song " + At("song.wav") + Server());
  EXPECT_EQ(late.code, 1);
  EXPECT_THAT(late.said, HasSubstr("--at: 100 s is after the song's end at 3 s"));
}

}  // namespace choreo::dance_refusals_test
