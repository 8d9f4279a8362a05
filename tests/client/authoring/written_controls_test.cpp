#include "client/authoring/controls/written_controls.h"

#include <gtest/gtest.h>

#include "client/authoring/project/project_file.h"
#include "client/cli/options/options.h"
#include "tests/support/expect_error.h"

namespace choreo::authoring::written_controls_test {

const nlohmann::json kProject = {{"studio", 1},
                                 {"lively", {{"left arm", 1.5}}},
                                 {"path", {{"points", nlohmann::json::array()}}},
                                 {"keyframes", {{{"id", "a"}}}}};

/// The field that people see.
std::string Typed(const Error& error) { return cli::AsTyped(error).field(); }

Error AskedOf(const WrittenControls& controls) {
  try {
    controls.Read({.name = "plain"},
                  {.models = {{.name = "free", .controls = {"root_path", "velocity_factors"}}},
                   .limits = {}});
  } catch (const Error& error) {
    return error;
  }
  return {ErrorCode::kInternal, "", "was not refused"};
}

TEST(WrittenControls, ErrorsNameWhereAControlWasWritten) {
  const WrittenControls project = ParseProject(kProject, "p.json").controls;
  const Error refused(ErrorCode::kInvalidArgument, "controls[0].velocity_factors", "no");
  const Error path(ErrorCode::kInvalidArgument, "controls[0].root_path", "no");
  EXPECT_EQ(AskedOf(project).field(), "p.json:path");
  EXPECT_EQ(project.InTermsOf(refused).field(), "p.json:lively");
  EXPECT_EQ(project.InTermsOf(path).field(), "p.json:path");

  WrittenControls options;
  options["velocity_factors"].sources = {"trunk=2"};
  EXPECT_EQ(Typed(AskedOf(options)), "--velocity");
  options.Follow(project);
  EXPECT_EQ(Typed(options.InTermsOf(refused)), "--velocity") << "which counts";
  options["root_path"].sources = {"x.json"};
  EXPECT_EQ(Typed(options.InTermsOf(path)), "--path");
  WrittenControls none;
  none.Follow(project);
  EXPECT_EQ(Typed(none.InTermsOf(refused)), "p.json:lively");
  EXPECT_EQ(std::string(AskedOf(none).what()),
            "p.json:path: the model \"plain\" does not have this control, but these models of the "
            "server have it: \"free\"");
}

TEST(WrittenControls, ReasonsOfTheApiGetTheOptions) {
  const auto typed = [](Remedy remedy) {
    const Error error(ErrorCode::kInvalidArgument, "audio", "choose a part of it", remedy);
    return std::string(cli::AsTyped(error.Of("song.wav")).what());
  };
  EXPECT_EQ(typed(Remedy::kTakePart), "song.wav: choose a part of it (--song-start, --seconds)");
  EXPECT_EQ(typed(Remedy::kNone), "song.wav: choose a part of it");
}

TEST(WrittenControls, AProjectsAreReadAsTheyStand) {
  nlohmann::json file = kProject;
  file["lively"] = {{"left arm", 1.23456789}, {"trunk", 1}};
  file["path"]["points"] = {{{"time", 0}, {"x", 0}, {"z", 0.5}}, {{"time", 2}, {"x", 1}, {"z", 1}}};
  const client::ModelDescription model{.controls = {"root_path", "velocity_factors"}};
  WrittenControls options;
  options["velocity_factors"].sources = {"trunk=2"};
  options.Follow(ParseProject(file, "p.json").controls);
  const ControlRequest read = options.Read(model, {.models = {}, .limits = {}});
  EXPECT_EQ(read.velocity_factors->factors, (std::vector<double>{2, 1.23456789}));
  EXPECT_EQ(read.root_path->frames, (std::vector<int64_t>{0, 60}));
  EXPECT_EQ(read.root_path->points[0].y(), 0.5);
  options["velocity_factors"].sources = {"trunk=1cm"};
  ExpectError(ErrorCode::kInvalidArgument, "velocity_factors",
              [&] { options.Read(model, {.models = {}, .limits = {}}); });
}

}  // namespace choreo::authoring::written_controls_test
