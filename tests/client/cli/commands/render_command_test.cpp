#include <gtest/gtest.h>

#include "model/core/files/atomic_file.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/run_choreo.h"
#include "tests/support/temporary_folder.h"

namespace choreo::render_command_test {

TEST(RenderCommand, APoseThatIsHeldIsOneKeyOfASheet) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return "'" + (folder / name).string() + "'"; };
  const Skeleton& body = Skeleton::Smpl24();
  WriteMotion(folder / "d.npz", body, {.fps = 30, .frames = std::vector(91, RestPose(body))});
  const auto draw = [&](const std::string& png, const std::string& held) {
    WriteFile(folder / "r.json",
              R"({"frames": 91, "fps": 30, "keyframes": [{"id": "a", "frame": 30})" + held + "]}");
    const Outcome outcome = Choreo("render " + at("d.npz") + " --frames 4 --report " +
                                   at("r.json") + " --out " + at(png.c_str()));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return ReadFile(folder / png);
  };
  const auto passed = draw("passed.png", "");
  EXPECT_EQ(draw("held.png", R"(, {"id": "a held 1", "frame": 60, "holds": "a"})"), passed);
  EXPECT_NE(draw("two.png", R"(, {"id": "b", "frame": 60})"), passed);
}

TEST(RenderCommand, ARateChoosesTheFramesOfASheet) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return "'" + (folder / name).string() + "'"; };
  const Skeleton& body = Skeleton::Smpl24();
  WriteMotion(folder / "d.npz", body, {.fps = 30, .frames = std::vector(16, RestPose(body))});
  const auto draw = [&](const std::string& options) {
    const Outcome outcome = Choreo("render " + at("d.npz") + options + " --out " + at("a.png"));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return ReadFile(folder / "a.png");
  };
  EXPECT_EQ(draw(" --rate 2"), draw(" --frames 2"));
  EXPECT_EQ(draw(" --rate 100"), draw(" --frames 16"));
  const Outcome both =
      Choreo("render " + at("d.npz") + " --rate 1 --frames 4 --out " + at("a.png"));
  EXPECT_EQ(both.code, 2);
  EXPECT_NE(both.said.find("--rate"), std::string::npos) << both.said;
}

}  // namespace choreo::render_command_test
