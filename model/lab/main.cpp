#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "model/core/threads.h"
#include "model/evaluation/eval_command.h"

#ifdef CHOREO_SERVICE
#include "model/training/prepare_command.h"
#endif
#include "model/training/train_command.h"

/// choreo-lab: prepares data, trains models and measures them. Serving is choreod's.
int main(int argc, char** argv) {
  CLI::App app("Prepare data, train models, measure them");
  app.require_subcommand(1);
#ifdef CHOREO_SERVICE  // preparation decodes music, which needs libsndfile
  choreo::AddPrepareCommand(app);
#endif
  choreo::AddTrainCommand(app);
  choreo::AddEvalCommand(app);
  try {
    const std::string warning = choreo::RequireFastBlas(choreo::DetectBlas());
    if (!warning.empty()) std::fprintf(stderr, "choreo-lab: %s\n", warning.c_str());
    choreo::FlushDenormals();
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "choreo-lab: %s\n", error.what());
    return 1;
  }
  return 0;
}
