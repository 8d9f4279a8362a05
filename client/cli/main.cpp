#include <grpc/support/log.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "client/authoring/notes/notes.h"
#include "client/cli/commands/commands.h"
#include "client/cli/options/interruption.h"
#include "client/cli/options/misspelling.h"
#include "client/cli/options/options.h"
#include "model/core/error.h"
#include "model/core/programs.h"

namespace {

constexpr int kInterrupted = 130;  // shells' code for Ctrl-C

/// The arguments behind the program, last first: `choreo help dance` is `choreo dance --help`.
std::vector<std::string> ArgumentsOf(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (!arguments.empty() && arguments.front() == "help") {
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  std::ranges::reverse(arguments);
  return arguments;
}

int Fail(const std::exception& error) {
  if (choreo::cli::Interruption::Came()) return kInterrupted;
  std::cerr << "choreo: " << error.what() << std::endl;
  return choreo::kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  // We report errors ourselves; gRPC logs only on request.
  if (std::getenv("GRPC_VERBOSITY") == nullptr) gpr_set_log_function([](gpr_log_func_args*) {});
  choreo::authoring::SetNoteSink([](const std::string& line) { std::cerr << line + '\n'; });
  CLI::App program{"choreo makes people dance: a song and key poses in, SMPL motion out.",
                   "choreo"};
  program.set_version_flag("--version", CHOREO_VERSION);
  program.require_subcommand(1);
  program.failure_message([&program](const CLI::App*, const CLI::Error& error) {
    const std::string misspelling = choreo::cli::DescribeMisspelling(program);
    return "choreo: " +
           (misspelling.empty() ? error.what() + std::string("; see --help") : misspelling) + "\n";
  });
  choreo::cli::AddDanceCommand(program);
  choreo::cli::AddLiveCommand(program);
  choreo::cli::AddTransitionCommand(program);
  choreo::cli::AddEditCommand(program);
  choreo::cli::AddAnalyzeCommand(program);
  choreo::cli::AddCheckCommand(program);
  choreo::cli::AddInfoCommand(program);
  choreo::cli::AddHealthCommand(program);
  choreo::cli::AddServeCommand(program);
  choreo::cli::AddConvertCommand(program);
  choreo::cli::AddPoseCommand(program);
  choreo::cli::AddPlotCommand(program);
  choreo::cli::AddRenderCommand(program);
  choreo::cli::AddStudioCommand(program);
  try {
    program.parse(ArgumentsOf(argc, argv));
    return 0;
  } catch (const CLI::ParseError& error) {
    // Help and version end here, too, with code 0.
    return program.exit(error) == 0 ? 0 : choreo::kMisused;
  } catch (const choreo::Error& error) {
    return Fail(choreo::cli::AsTyped(error));
  } catch (const std::exception& error) {
    return Fail(error);
  }
}
