#include "model/training/train_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>

#include "model/controllers/controllers_config.h"
#include "model/core/error.h"
#include "model/training/trainer.h"

namespace choreo {
namespace {

constexpr const char* kContinuous = "default";
constexpr std::string_view kPresets[] = {kContinuous, "paper", "ablation",
                                         ControllersConfig::kPreset};

// Switches that only flows, or only controllers (true), have.
constexpr std::pair<const char*, bool> kAblations[] = {
    {"--no-keys", false},           {"--no-time-embedding", false}, {"--forward-embedding", false},
    {"--one-lstm", true},           {"--condition-fc", true},       {"--one-decoder", true},
    {"--no-velocity-factors", true}};

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
  command->add_flag("--with-validation", options->with_validation,
                    "Train on the validation clips too, once everything is chosen");
  command->add_option("--from", options->from,
                      "Checkpoint whose network the run starts from (same preset)");
  command->add_option("--run", options->run, "Folder for state, curves and the checkpoint")
      ->required();
  command
      ->add_option("--device", options->device, "auto | cpu | cuda:N; controllers train on the CPU")
      ->capture_default_str();
  command->add_flag("--resume", options->resume, "Go on from the run's saved state");
  command->add_option("--steps", options->steps, "Steps of the run")->capture_default_str();
  command->add_option("--batch", options->batch, "Windows a step")->capture_default_str();
  command->add_option("--rate", options->rate, "Peak learning rate")->capture_default_str();
  command->add_option("--shortest", options->shortest, "Shortest training transition, frames")
      ->capture_default_str();
  command->add_option("--longest", options->longest, "Longest training transition, frames")
      ->capture_default_str();
  command
      ->add_option("--rollout-frames", options->rollout_frames,
                   "Frames of the roll-out that a flow's key loss samples")
      ->capture_default_str();
  command
      ->add_option("--tempo", options->tempo,
                   "Share of the windows that are danced faster or slower (preset default)")
      ->capture_default_str();
  command->add_option("--report-every", options->report_every, "Steps between reports")
      ->capture_default_str();
  command
      ->add_option("--stop-after", options->stop_after,
                   "Leave after this many steps of the run, to be resumed; 0: to the end")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Same seed, data and machine: same checkpoint")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_flag("--no-keys", options->no_keys, "Ablation: music alone");
  command->add_flag("--no-key-loss", options->no_key_loss, "Ablation: no key pose loss");
  command->add_flag("--no-time-embedding", options->no_time_embedding,
                    "Ablation: no time embedding");
  command->add_flag("--forward-embedding", options->forward_embedding,
                    "Ablation: count frames from the start, not frames left");
  command->add_flag("--one-lstm", options->one_lstm, "Ablation of controllers");
  command->add_flag("--condition-fc", options->condition_fc,
                    "Ablation of controllers: fully connected instead of transformers");
  command->add_flag("--one-decoder", options->one_decoder, "Ablation of controllers");
  command->add_flag("--no-velocity-factors", options->no_velocity_factors,
                    "Ablation of controllers");
  command->callback([options, read_device, command] {
    const bool controllers = options->preset == ControllersConfig::kPreset;
    for (const auto& [option, of_controllers] : kAblations) {
      if (of_controllers != controllers && command->count(option) > 0)
        throw InvalidArgument(option, "is no ablation of the preset " + options->preset);
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
