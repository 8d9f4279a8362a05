#include "model/lab/train_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>
#include <type_traits>

#include "model/core/error.h"
#include "model/core/limits.h"
#include "model/papers/training/paper_options.h"
#include "model/training/trainer/trainer.h"

namespace choreo {
namespace {

constexpr const char* kDefaultPreset = "default";
constexpr std::string_view kPresets[] = {
    kDefaultPreset, "paper", "paper-f", "ablation", ControllersConfig::kPreset, kInbetweenerPreset};
constexpr const char* kPresetNames = "default, paper, paper-f, ablation, controllers-paper, harvey";

// VisitFixed for all presets: `visit(option, value, is_used, what)`; `is_used`: this preset uses
// the option.
void VisitAll(auto& options, auto&& visit) {
  const bool continuous = options.preset == kDefaultPreset;
  VisitFixed(options, [&](const char* option, auto& value, const char* what) {
    visit(option, value, true, what);
  });
  VisitFixedOfDefault(options, [&](const char* option, auto& value, const char* what) {
    visit(option, value, continuous, what);
  });
  VisitFixedOfPapers(options, [&](const char* option, auto& value, bool is_used, const char* what) {
    visit(option, value, is_used && !continuous, what);
  });
}

// Throws Error(kInvalidArgument) for an option that the preset does not use, unless it has its
// default: a card lists all options, so that it can be typed.
void RefuseUnusedOptions(const CLI::App& command, const PaperOptions& options) {
  VisitAll(options, [&](const char* option, const auto& value, bool is_used, const char*) {
    const CLI::Option& given = *command.get_option(option);
    if (is_used || given.empty() || given.results().front() == given.get_default_str()) return;
    const bool flag = std::is_same_v<decltype(value), const bool&>;
    throw InvalidArgument(option, std::string("is not an ") + (flag ? "ablation" : "option") +
                                      " of the preset " + options.preset);
  });
  if (options.blend != 1 && options.preset != kDefaultPreset)
    throw InvalidArgument("--blend", "is not an option of the preset " + options.preset);
}

void Train(PaperOptions options,
           const std::function<std::string(const std::string&)>& read_device) {
  const bool small = options.IsControllers() || options.IsInbetweener();
  if (small && options.device == "auto") options.device = "cpu";
  options.device = read_device(options.device);
  if (small && options.device != "cpu") {
    throw InvalidArgument(
        "--device", options.device + ", but the preset " + options.preset + " trains on the CPU");
  }
  if (options.IsControllers()) {
    TrainControllers(options);
  } else if (options.IsInbetweener()) {
    TrainInbetweener(options);
  } else if (options.preset == kDefaultPreset) {
    TrainContinuousFlow(TrainOptions(options));
  } else {
    TrainFlow(options);
  }
}

}  // namespace

void AddTrainCommand(CLI::App& app,
                     const std::function<std::string(const std::string&)>& read_device) {
  auto options = std::make_shared<PaperOptions>();
  CLI::App* command = app.add_subcommand("train", "Train a model on prepared clips");
  command
      ->add_option("--preset", options->preset,
                   "default | paper | paper-f (a twentieth of its size) | ablation (smaller "
                   "still) | controllers-paper | harvey (the baseline of both papers)")
      ->capture_default_str()
      ->check(CLI::Validator(
          [](const std::string& name) {
            return std::ranges::find(kPresets, name) != std::end(kPresets)
                       ? std::string()
                       : "'" + name + "' is not one of " + kPresetNames;
          },
          ""));
  command->add_option("--name", options->name,
                      "The model's name on servers; default: the preset's");
  command
      ->add_option("--served-temperature", options->flow.temperature,
                   "The flow's default sampling temperature; also rewrites a finished run with it")
      ->check(CLI::Range(0.0, kMaxTemperature))
      ->capture_default_str();
  command->add_option("--data", options->data, "Folders written by `choreo-lab prepare`")
      ->required();
  command->add_option("--splits", options->splits, "Which clip trains, validates, tests (JSON)")
      ->required();
  command->add_option("--from", options->from,
                      "Checkpoint whose network the run starts from (same preset)");
  command->add_option("--blend", options->blend,
                      "Share of the trained weights in the checkpoint of the preset default, the "
                      "rest is --from's; also rewrites a finished run with it");
  command->add_option("--run", options->run, "Folder for state, curves and the checkpoint")
      ->required();
  command->option_defaults()->always_capture_default();
  command->add_option("--device", options->device,
                      "auto | cpu | cuda:N; controllers and the baseline train on the CPU");
  command->add_option("--report-every", options->report_every, "Steps between reports");
  command->add_option("--stop-after", options->stop_after,
                      "Stop, resumable, after this many steps of the run; 0: run to the end");
  command->add_flag("--resume", options->resume, "Continue from the run's saved state");
  VisitAll(*options, [&](const char* option, auto& value, bool, const char* what) {
    if constexpr (std::is_same_v<decltype(value), bool&>) {
      command->add_flag(option, value, what);
    } else {
      command->add_option(option, value, what);
    }
  });
  command->get_option("--seed")->check(CLI::NonNegativeNumber);
  command->callback([command, options, read_device] {
    RefuseUnusedOptions(*command, *options);
    Train(*options, read_device);
  });
}

}  // namespace choreo
