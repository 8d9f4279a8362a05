#include <exception>
#include <iostream>

#include "client/cli/commands.h"
#include "model/core/error.h"

namespace {

constexpr int kFailed = 1;
constexpr int kMisused = 2;

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{"choreo makes people dance: a song and key poses in, SMPL motion out.",
                   "choreo"};
  program.set_version_flag("--version", CHOREO_VERSION);
  program.require_subcommand(1);
  choreo::cli::AddDanceCommand(program);
  choreo::cli::AddTransitionCommand(program);
  choreo::cli::AddEditCommand(program);
  choreo::cli::AddAnalyzeCommand(program);
  choreo::cli::AddInfoCommand(program);
  choreo::cli::AddHealthCommand(program);
  choreo::cli::AddConvertCommand(program);
  choreo::cli::AddRenderCommand(program);
  try {
    program.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    // Help and version come this way too, with code 0.
    return program.exit(error) == 0 ? 0 : kMisused;
  } catch (const std::exception& error) {
    std::cerr << "choreo: " << error.what() << std::endl;
    return kFailed;
  }
}
