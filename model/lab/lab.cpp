#include "model/lab/lab.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "model/core/error.h"
#include "model/core/programs.h"
#include "model/core/running/threads.h"
#include "model/evaluation/tables/weigh_command.h"
#include "model/lab/eval_command.h"
#include "model/lab/train_command.h"
#include "model/papers/tables/study_command.h"
#include "model/samplers/samplers.h"

#ifdef CHOREO_SERVICE
#include "model/training/prepare/prepare.h"
#endif

namespace choreo {
namespace {

/// The device with this name. Throws for several, because a model is trained on one.
std::string OneDevice(const std::string& name) {
  const auto devices = ParseDevices(name, TorchDevices());
  if (devices.size() > 1)
    throw InvalidArgument("--device", "'" + name + "' names several, training takes one");
  return devices.front().name();
}

}  // namespace

int RunLab(int argc, const char* const* argv) {
  CLI::App app("Prepare data, train models, measure them", "choreo-lab");
  app.set_version_flag("--version", CHOREO_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("choreo-lab: ") + error.what() + "; see --help\n";
  });
#ifdef CHOREO_SERVICE  // preparation decodes music, which needs libsndfile
  AddPrepareCommand(app);
#endif
  AddTrainCommand(app, OneDevice);
  AddEvalCommand(app);
  AddWeighCommand(app);
  AddStudyCommand(app);
  try {
    const std::string warning = RequireFastBlas(DetectBlas());
    if (!warning.empty()) std::fprintf(stderr, "choreo-lab: %s\n", warning.c_str());
    FlushDenormals();
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // --help and --version end here, too, with code 0.
    return app.exit(error) == 0 ? 0 : kMisused;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "choreo-lab: %s\n", error.what());
    return kFailed;
  }
  return 0;
}

}  // namespace choreo
