#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/run_choreo.h"
#include "tests/support/temporary_folder.h"

namespace choreo::check_command_test {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// A folder with a motion of four seconds that stands still, and one that hangs in the air from
/// second 1 to 3, and then sinks into the floor.
class CheckCommandTest : public testing::Test {
 protected:
  CheckCommandTest() {
    Motion motion;
    motion.frames.assign(120, StandingPose(Body()));
    WriteMotion(folder_ / "clean.npz", Body(), motion);
    for (int frame = 30; frame < 90; ++frame) motion.frames[frame].root_position.y() += 0.5;
    for (int frame = 100; frame < 120; ++frame) motion.frames[frame].root_position.y() -= 0.1;
    WriteMotion(folder_ / "faulty.npz", Body(), motion);
  }

  std::string At(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }

  TemporaryFolder folder_;
};

TEST_F(CheckCommandTest, ListsTheFaultsOfADance) {
  const Outcome clean = Choreo("check " + At("clean.npz"));
  EXPECT_EQ(clean.code, 0) << clean.said;
  EXPECT_EQ(clean.said, "no faults\n");
  const Outcome faulty = Choreo("check " + At("faulty.npz"));
  EXPECT_EQ(faulty.code, 0) << faulty.said;
  EXPECT_THAT(faulty.said,
              testing::MatchesRegex("1 s to 2.97 s: the body floats 50 cm above the floor\n"
                                    "3.33 s to 3.97 s: [a-z_]+: [0-9.]+ cm under the floor\n"
                                    "2 faults: 1 floating, 1 under the floor\n"));
}

TEST_F(CheckCommandTest, PrintsThemForPrograms) {
  const Outcome outcome = Choreo("check --json " + At("faulty.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const auto out = nlohmann::json::parse(outcome.said);
  EXPECT_EQ(out["frames"], 120);
  EXPECT_EQ(out["shares"]["floating"], 0.5);
  EXPECT_EQ(out["shares"]["arm_inside"], 0);
  ASSERT_EQ(out["faults"].size(), 2U);
  const auto& floats = out["faults"][0];
  EXPECT_EQ(floats["kind"], "floating");
  EXPECT_EQ(floats["frame"], 30);
  EXPECT_EQ(floats["last_frame"], 89);
  EXPECT_EQ(floats["time"], 1);
  EXPECT_EQ(floats["joint"], "pelvis");
  EXPECT_NEAR(floats["worst"].get<double>(), 0.5, 1e-3);
  EXPECT_EQ(floats["limit"], 0.1);
  EXPECT_EQ(floats["unit"], "m");
  EXPECT_FALSE(floats.contains("count"));
}

TEST_F(CheckCommandTest, CountsTheBeatsOfTheReport) {
  std::ofstream(folder_ / "report.json")
      << R"({"fps": 30, "keyframes": [], "music_beats": [0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5]})";
  const Outcome outcome = Choreo("check " + At("faulty.npz") + " --report " + At("report.json"));
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("3c, 1 s to 2.97 s: "));
}

TEST_F(CheckCommandTest, RefusesWhatIsNoMotion) {
  std::ofstream(folder_ / "song.wav") << "RIFF";
  const Outcome outcome = Choreo("check " + At("song.wav"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("song.wav"));
}

}  // namespace choreo::check_command_test
