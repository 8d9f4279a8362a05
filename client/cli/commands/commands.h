#pragma once

#include <CLI/CLI.hpp>

/// The commands of `choreo`, one file each. Each adds itself with its help to the program, and runs
/// while the command line is parsed. Failures are thrown as Error.
namespace choreo::cli {

void AddDanceCommand(CLI::App& program);
void AddLiveCommand(CLI::App& program);
void AddTransitionCommand(CLI::App& program);
void AddEditCommand(CLI::App& program);
void AddAnalyzeCommand(CLI::App& program);
void AddCheckCommand(CLI::App& program);
void AddInfoCommand(CLI::App& program);
void AddHealthCommand(CLI::App& program);
void AddServeCommand(CLI::App& program);
void AddConvertCommand(CLI::App& program);
void AddPoseCommand(CLI::App& program);
void AddPlotCommand(CLI::App& program);
void AddRenderCommand(CLI::App& program);
void AddStudioCommand(CLI::App& program);

}  // namespace choreo::cli
