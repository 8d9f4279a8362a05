#include "model/training/train_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>

#include "model/controllers/controllers_config.h"
#include "model/core/error.h"
#include "model/training/trainer.h"

namespace choreo {
namespace {

constexpr const char* kContinuous = "default";
constexpr std::string_view kPresets[] = {kContinuous, "paper", "ablation",
                                         ControllersConfig::kPreset};

}  // namespace

void AddTrainCommand(CLI::App& app, const DeviceReader& read_device) {
  auto options = std::make_shared<TrainOptions>();
  CLI::App* command = app.add_subcommand("train", "Train a model on prepared clips");
  command
      ->add_option("--preset", options->preset,
                   "default | paper | ablation (the same, smaller) | controllers-paper")
      ->capture_default_str()
      ->check(CLI::Validator(
          [](const std::string& name) {
            return std::ranges::find(kPresets, name) != std::end(kPresets)
                       ? std::string()
                       : "'" + name + "' is not one of default, paper, ablation, controllers-paper";
          },
          ""));
  command->add_option("--name", options->name,
                      "What servers call the model; default: the preset's name");
  command->add_option("--data", options->data, "Folders written by `choreo-lab prepare`")
      ->required();
  command->add_option("--splits", options->splits, "Which clip trains, validates, tests (JSON)")
      ->required();
  command->add_option("--from", options->from,
                      "Checkpoint whose network the run starts from (same preset)");
  command->add_option("--run", options->run, "Folder for state, curves and the checkpoint")
      ->required();
  command->option_defaults()->always_capture_default();
  const auto add = [&](const char* name, auto& value, const char* what) {
    return command->add_option(name, value, what);
  };
  add("--device", options->device, "auto | cpu | cuda:N; controllers train on the CPU");
  add("--steps", options->steps, "Steps of the run");
  add("--batch", options->batch, "Windows a step");
  add("--rate", options->rate, "Peak learning rate");
  add("--shortest", options->shortest, "Shortest training transition, frames");
  add("--longest", options->longest, "Longest training transition, frames");
  add("--rollout-frames", options->rollout_frames,
      "Frames of the roll-out that a flow's key loss samples");
  add("--tempo", options->tempo,
      "Share of the windows that are danced faster or slower (preset default)");
  add("--report-every", options->report_every, "Steps between reports");
  add("--stop-after", options->stop_after,
      "Leave after this many steps of the run, to be resumed; 0: to the end");
  add("--seed", options->seed, "Same seed, data and machine: same checkpoint")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--resume", options->resume, "Go on from the run's saved state");
  command->add_flag("--with-validation", options->with_validation,
                    "Train on the validation clips too, once everything is chosen");
  for (const Ablation& ablation : kAblations)
    command->add_flag(ablation.option, (*options).*ablation.on, ablation.what);
  command->callback([options, read_device] {
    const bool controllers = options->preset == ControllersConfig::kPreset;
    for (const Ablation& ablation : kAblations) {
      if ((*options).*ablation.on && !(controllers ? ablation.of_controllers : ablation.of_flows))
        throw InvalidArgument(ablation.option, "is no ablation of the preset " + options->preset);
    }
    if (controllers && options->device == "auto") options->device = "cpu";
    options->device = read_device(options->device);
    if (controllers) {
      if (options->device != "cpu")
        throw InvalidArgument("--device", options->device + ", but controllers train on the CPU");
      TrainControllers(*options);
    } else if (options->preset == kContinuous) {
      TrainContinuousFlow(*options);
    } else {
      TrainFlow(*options);
    }
  });
}

}  // namespace choreo
