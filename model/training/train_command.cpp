#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <sstream>
#include <string_view>
#include <type_traits>

#include "model/controllers/controllers_config.h"
#include "model/core/error.h"
#include "model/core/limits.h"
#include "model/training/trainer.h"

namespace choreo {
namespace {

constexpr std::string_view kPresets[] = {
    "default", "paper", "paper-f", "ablation", ControllersConfig::kPreset, kInbetweenerPreset};
constexpr const char* kPresetNames = "default, paper, paper-f, ablation, controllers-paper, harvey";

// Calls `visit(option, value, is_used, what)` of each option, --preset and --from aside, that a
// run must keep; `is_used`: the preset's network has a use for it.
void VisitFixed(auto& options, const auto& visit) {
  const bool controllers = options.IsControllers(), continuous = options.IsContinuousFlow();
  const bool inbetweener = options.IsInbetweener();
  const bool flow = !controllers && !continuous && !inbetweener;
  visit("--steps", options.steps, true, "Steps of the run");
  visit("--batch", options.batch, true, "Windows a step");
  visit("--rate", options.rate, true, "Peak learning rate");
  visit("--shortest", options.shortest, !continuous, "Shortest training transition, frames");
  visit("--longest", options.longest, !continuous, "Longest training transition, frames");
  visit("--clip", options.clip, true, "Norm that gradients are clipped to; 0: never");
  visit("--flow-steps", options.flow.flow_steps, flow, "Steps K of a flow; 0: the preset's");
  visit("--hidden", options.flow.hidden, flow || inbetweener,
        "Width of the LSTMs of a flow or the baseline; 0: the preset's");
  visit("--condition-width", options.flow.condition_width, flow,
        "Width of the encoding that all couplings share, 0: none; -1: the preset's");
  visit("--no-innovations", options.flow.no_innovations, flow,
        "Draw frames themselves (the paper), not what is left beyond a linear prediction");
  visit("--rollout-share", options.flow.rollout_share, flow,
        "Share of a step's windows that are sampled for the key and feet losses");
  visit("--rollout-from", options.flow.rollout_from, flow,
        "Step at which the key and feet losses begin: before it the likelihood is learnt alone");
  visit("--rollout-loss", options.flow.rollout_loss, flow,
        "Weight of the sampled way's distance from the real one (not in the paper)");
  visit("--dequantise", options.flow.dequantise, flow,
        "Noise on what the likelihood is of, share of each feature's spread");
  visit("--tempo", options.tempo, true,
        "Share of the windows that are danced up to a third faster or slower");
  visit("--seed", options.seed, true, "Same seed, data and machine: same checkpoint");
  visit("--keep-statistics", options.keep_statistics, continuous,
        "With --from: what that measured of its data stays, and what it does not know is measured");
  visit("--no-keys", options.flow.no_keys, flow, "Ablation: music alone");
  visit("--no-key-loss", options.no_key_loss, flow || controllers, "Ablation: no key pose loss");
  visit("--no-time-embedding", options.flow.no_time_embedding, flow, "Ablation: no time embedding");
  visit("--forward-embedding", options.flow.forward_embedding, flow,
        "Ablation: count frames from the start, not frames left");
  visit("--truth-decay", options.controllers.truth_decay, controllers,
        "Scheduled sampling: what each step leaves of the real frames' share in what is fed back");
  visit("--residual", options.controllers.residual, controllers,
        "Controllers draw what is added to interpolation on the path (not in the paper)");
  visit("--no-absolute-position", options.controllers.no_absolute_position, controllers,
        "Ablation of controllers: relative position coding alone");
  visit("--no-relative-position", options.controllers.no_relative_position, controllers,
        "Ablation of controllers: absolute position coding alone");
  visit("--one-lstm", options.controllers.one_lstm, controllers, "Ablation of controllers");
  visit("--condition-fc", options.controllers.condition_fc, controllers,
        "Ablation of controllers: fully connected instead of transformers");
  visit("--one-decoder", options.controllers.one_decoder, controllers, "Ablation of controllers");
  visit("--no-velocity-factors", options.controllers.no_velocity_factors, controllers,
        "Ablation of controllers");
}

}  // namespace

std::string TrainOptions::Command() const {
  std::ostringstream command;
  command << "choreo-lab train";
  for (const auto& folder : data) command << " --data " << folder.filename().string();
  command << " --splits " << splits.filename().string() << ' ' << Fixed();
  if (!from.empty()) command << " --from " << from.filename().string();
  if (!name.empty()) command << " --name " << name;
  if (flow.temperature != 1) command << " --served-temperature " << flow.temperature;
  return command.str();
}

std::string TrainOptions::Fixed() const {
  std::ostringstream text;
  text << "--preset " << preset;
  std::string flags;
  VisitFixed(*this, [&](const char* option, const auto& value, bool, const char*) {
    if constexpr (!std::is_same_v<decltype(value), const bool&>) {
      text << ' ' << option << ' ' << value;
    } else if (value) {
      flags += std::string(" ") + option;
    }
  });
  return text.str() + flags;
}

void TrainOptions::Validate() const {
  const auto require = [](bool good, const char* option, const std::string& value,
                          const char* limit) {
    if (!good) throw InvalidArgument(option, value + ", but it must be " + limit);
  };
  require(name.size() <= kMostNameBytes, "--name", name,
          ("at most " + std::to_string(kMostNameBytes) + " bytes").c_str());
  require(!data.empty(), "--data", "nothing", "at least one folder of prepared clips");
  require(steps >= 1, "--steps", std::to_string(steps), "at least 1");
  require(batch >= 4 && batch <= 4096, "--batch", std::to_string(batch), "4 to 4096");
  require(shortest >= 2 && shortest <= longest && longest <= 600, "--longest",
          std::to_string(longest), "from --shortest (at least 2) to 600");
  require(clip >= 0, "--clip", std::to_string(clip), "at least 0");
  require(flow.flow_steps >= 0 && flow.flow_steps <= 64, "--flow-steps",
          std::to_string(flow.flow_steps), "0 to 64");
  require(flow.hidden >= 0 && flow.hidden <= 4096, "--hidden", std::to_string(flow.hidden),
          "0 to 4096");
  require(flow.condition_width >= -1 && flow.condition_width <= 4096, "--condition-width",
          std::to_string(flow.condition_width), "-1 to 4096");
  require(flow.rollout_share > 0 && flow.rollout_share <= 1, "--rollout-share",
          std::to_string(flow.rollout_share), "above 0, to 1");
  require(flow.rollout_from >= 0, "--rollout-from", std::to_string(flow.rollout_from),
          "at least 0");
  require(flow.rollout_loss >= 0 && flow.rollout_loss <= 100, "--rollout-loss",
          std::to_string(flow.rollout_loss), "0 to 100");
  require(flow.dequantise >= 0 && flow.dequantise <= 1, "--dequantise",
          std::to_string(flow.dequantise), "0 to 1");
  require(tempo >= 0 && tempo <= 1, "--tempo", std::to_string(tempo), "0 to 1");
  require(controllers.truth_decay >= 0 && controllers.truth_decay <= 1, "--truth-decay",
          std::to_string(controllers.truth_decay), "0 to 1");
  require(!IsControllers() || controllers.residual || !controllers.no_absolute_position ||
              !controllers.no_relative_position,
          "--no-relative-position", "with --no-absolute-position", "alone");
  require(!keep_statistics || !from.empty(), "--keep-statistics", "alone", "given with --from");
  require(report_every >= 1, "--report-every", std::to_string(report_every), "at least 1");
  require(stop_after >= 0, "--stop-after", std::to_string(stop_after), "at least 0");
  require(rate >= 0 && rate <= 1, "--rate", std::to_string(rate), "0 to 1");
}

void AddTrainCommand(CLI::App& app,
                     const std::function<std::string(const std::string&)>& read_device) {
  auto options = std::make_shared<TrainOptions>();
  CLI::App* command = app.add_subcommand("train", "Train a model on prepared clips");
  command
      ->add_option("--preset", options->preset,
                   "default | paper | paper-f (the same, of a twentieth) | ablation (smaller "
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
                      "What servers call the model; default: the preset's name");
  command
      ->add_option("--served-temperature", options->flow.temperature,
                   "What a flow is sampled at unless a dance asks otherwise; a finished run is "
                   "written anew with it")
      ->check(CLI::Range(0.0, kMaxTemperature))
      ->capture_default_str();
  command->add_option("--data", options->data, "Folders written by `choreo-lab prepare`")
      ->required();
  command->add_option("--splits", options->splits, "Which clip trains, validates, tests (JSON)")
      ->required();
  command->add_option("--from", options->from,
                      "Checkpoint whose network the run starts from (same preset)");
  command->add_option("--run", options->run, "Folder for state, curves and the checkpoint")
      ->required();
  command->option_defaults()->always_capture_default();
  command->add_option("--device", options->device,
                      "auto | cpu | cuda:N; controllers and the baseline train on the CPU");
  command->add_option("--report-every", options->report_every, "Steps between reports");
  command->add_option("--stop-after", options->stop_after,
                      "Leave after this many steps of the run, to be resumed; 0: to the end");
  command->add_flag("--resume", options->resume, "Go on from the run's saved state");
  VisitFixed(*options, [&](const char* option, auto& value, bool, const char* what) {
    if constexpr (std::is_same_v<decltype(value), bool&>) {
      command->add_flag(option, value, what);
    } else {
      command->add_option(option, value, what);
    }
  });
  command->get_option("--seed")->check(CLI::NonNegativeNumber);
  command->callback([command, options, read_device] {
    VisitFixed(*options, [&](const char* option, const auto& value, bool is_used, const char*) {
      const CLI::Option& given = *command->get_option(option);
      // A card names all options, those that are not used at their defaults: it can be typed.
      if (is_used || given.empty() || given.results().front() == given.get_default_str()) return;
      const bool flag = std::is_same_v<decltype(value), const bool&>;
      throw InvalidArgument(option, std::string("is no ") + (flag ? "ablation" : "option") +
                                        " of the preset " + options->preset);
    });
    const bool small = options->IsControllers() || options->IsInbetweener();
    if (small && options->device == "auto") options->device = "cpu";
    options->device = read_device(options->device);
    if (small && options->device != "cpu") {
      throw InvalidArgument("--device", options->device + ", but the preset " + options->preset +
                                            " trains on the CPU");
    }
    if (options->IsControllers()) {
      TrainControllers(*options);
    } else if (options->IsInbetweener()) {
      TrainInbetweener(*options);
    } else if (options->IsContinuousFlow()) {
      TrainContinuousFlow(*options);
    } else {
      TrainFlow(*options);
    }
  });
}

}  // namespace choreo
