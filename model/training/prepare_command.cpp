#include "model/training/prepare_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "model/core/error.h"
#include "model/training/prepare.h"

namespace choreo {

void AddPrepareCommand(CLI::App& app) {
  auto options = std::make_shared<PrepareOptions>();
  CLI::App* command = app.add_subcommand("prepare", "Turn recordings into training clips");
  command->add_option("layout", options->layout, "tang2018 | tang61 | bvh | amass | aist | lafan1")
      ->required()
      ->check(CLI::IsMember({"tang2018", "tang61", "bvh", "amass", "aist", "lafan1"}));
  command->add_option("input", options->input, "Folder of recordings")->required();
  command->add_option("output", options->output, "Folder for the clips")->required();
  command->add_option(
      "--frame-rate", options->frame_rates,
      "PREFIX FPS: the true rate of clips whose header is wrong (cmu_dance: salsa 60)");
  command->add_option("--time-scale", options->time_scales,
                      "PREFIX FACTOR: stretch these clips in time");
  command->add_flag("--native-skeleton", options->native_skeleton,
                    "tang2018: fit a skeleton of the data's own 23 joints instead of SMPL's 24");
  command->add_option("--terms", options->terms, "Terms of use, kept with every clip")
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Clips at once")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->callback([options] {
    if (Prepare(*options) == 0)
      throw Error(ErrorCode::kInvalidArgument, options->input.string(),
                  "no clip could be prepared");
  });
}

}  // namespace choreo
