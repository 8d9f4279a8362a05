#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "client/authoring/keys/motion_input.h"
#include "client/cli/commands/commands.h"
#include "client/cli/options/options.h"
#include "client/cli/report/dance_faults.h"
#include "client/cli/report/report_file.h"

namespace choreo::cli {
namespace {

struct CheckCommand {
  std::string dance;
  std::string report;
  bool json = false;
};

/// {"arm_inside": 0.002, ...}: the share of the frames with each kind of fault.
nlohmann::ordered_json SharesJson(const std::vector<DanceFault>& faults, int64_t frames) {
  std::vector<MotionFault> found;
  for (const DanceFault& one : faults) found.push_back(one.fault);
  nlohmann::ordered_json shares;
  for (size_t kind = 0; kind < kMotionFaults.size(); ++kind)
    shares[std::string(kMotionFaults[kind].name)] =
        FaultShare(found, static_cast<MotionFaultKind>(kind), frames);
  return shares;
}

void Run(const CheckCommand& options) {
  const SkeletonMotion dance = authoring::ReadMotionNoting(options.dance);
  TimeFormat times{dance.motion.fps};
  if (!options.report.empty()) {
    const ReportFile report = ReadReport(options.report);
    CheckSketch(options.report, report, dance.motion);
    times.counts = CountsOf(report.settings, options.report);
  }
  const std::vector<DanceFault> faults =
      FindDanceFaults(dance.skeleton, dance.motion, dance.motion.fps);
  if (!options.json) {
    std::cout << FaultLines(faults, times) << CountFaults(faults) << std::endl;
    return;
  }
  nlohmann::ordered_json out;
  const auto frames = std::ssize(dance.motion.frames);
  out["frames"] = frames;
  out["fps"] = dance.motion.fps;
  out["faults"] = FaultsJson(faults, times);
  out["shares"] = SharesJson(faults, frames);
  std::cout << out.dump(2) << std::endl;
}

}  // namespace

void AddCheckCommand(CLI::App& program) {
  auto options = std::make_shared<CheckCommand>();
  CLI::App* command = program.add_subcommand(
      "check",
      "List what looks wrong in a dance: arms inside the trunk, a body that floats, feet that "
      "slide, joints under the floor, limbs that snap.\nOne line a fault, in order of time, then "
      "how many there are. Most recordings of dancers keep the limits in 99 % of frames "
      "(docs/film.md).");
  command->add_option("dance", options->dance, MotionFileExtensions() + " file.")
      ->required()
      ->check(CLI::ExistingFile);
  command
      ->add_option("--report", options->report,
                   "Report of the dance: its beats, or its song's, give each fault its count.")
      ->check(CLI::ExistingFile);
  command->add_flag("--json", options->json,
                    "Print the faults as JSON, with the share of the frames that have each kind.");
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
