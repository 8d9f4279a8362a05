#include "client/authoring/written_controls.h"

#include <gtest/gtest.h>

#include "client/authoring/project_file.h"
#include "client/cli/options.h"
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
  options.velocities = {"trunk=2"};
  EXPECT_EQ(Typed(AskedOf(options)), "--velocity");
  options.Follow(project);
  EXPECT_EQ(Typed(options.InTermsOf(refused)), "--velocity") << "which counts";
  options.path = "x.json";
  EXPECT_EQ(Typed(options.InTermsOf(path)), "--path");
  WrittenControls none;
  none.Follow(project);
  EXPECT_EQ(Typed(none.InTermsOf(refused)), "p.json:lively");
  EXPECT_EQ(std::string(AskedOf(none).what()),
            "p.json:path: the model \"plain\" does not have this control, but these of the "
            "server do: \"free\"");
}

}  // namespace choreo::authoring::written_controls_test
