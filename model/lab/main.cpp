#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "model/core/error.h"
#include "model/core/programs.h"
#include "model/core/threads.h"
#include "model/evaluation/weigh_command.h"
#include "model/lab/eval_command.h"
#include "model/lab/train_command.h"
#include "model/papers/tables/study_command.h"
#include "model/samplers/samplers.h"

#ifdef CHOREO_SERVICE
#include "model/training/prepare.h"
#endif

namespace {

/// The device with this name. Throws for several, because a model is trained on one.
std::string OneDevice(const std::string& name) {
  const auto devices = choreo::ParseDevices(name, choreo::TorchDevices());
  if (devices.size() > 1)
    throw choreo::InvalidArgument("--device", "'" + name + "' names several, training takes one");
  return devices.front().name();
}

}  // namespace

/// choreo-lab prepares data, trains models and measures them; choreod serves them.
int main(int argc, char** argv) {
  CLI::App app("Prepare data, train models, measure them", "choreo-lab");
  app.set_version_flag("--version", CHOREO_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("choreo-lab: ") + error.what() + "; see --help\n";
  });
#ifdef CHOREO_SERVICE  // preparation decodes music, which needs libsndfile
  choreo::AddPrepareCommand(app);
#endif
  choreo::AddTrainCommand(app, OneDevice);
  choreo::AddEvalCommand(app);
  choreo::AddWeighCommand(app);
  choreo::AddStudyCommand(app);
  try {
    const std::string warning = choreo::RequireFastBlas(choreo::DetectBlas());
    if (!warning.empty()) std::fprintf(stderr, "choreo-lab: %s\n", warning.c_str());
    choreo::FlushDenormals();
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // --help and --version end here, too, with code 0.
    return app.exit(error) == 0 ? 0 : choreo::kMisused;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "choreo-lab: %s\n", error.what());
    return choreo::kFailed;
  }
  return 0;
}
