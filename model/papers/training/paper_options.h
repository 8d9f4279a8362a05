#pragma once

#include <cstdint>
#include <string>

#include "model/papers/networks/controllers_config.h"
#include "model/papers/networks/flow_config.h"
#include "model/training/trainer/trainer.h"

namespace choreo {

/// Options of paper F's flows, the presets `paper`, `paper-f` and `ablation`.
struct FlowOptions {
  int flow_steps = 0, hidden = 0;  ///< K, and width of the LSTMs; 0: the preset's
  int condition_width = -1;        ///< of the shared encoding, 0: none; -1: the preset's
  double rollout_share = 1;        ///< share of a step's windows sampled for L_key and L_feet
  int64_t rollout_from = 0;        ///< first step with L_key and L_feet; earlier samples are noise
  double rollout_loss =
      0;  ///< weight of the roll-out's distance from the real motion; not in the paper
  double temperature = 1;  ///< default when served
  double dequantise =
      0.05;  ///< noise added to the likelihood's features, as a share of their spread
  bool no_innovations = false;  ///< samples features as the paper does, in any preset
  bool no_keys = false, no_time_embedding = false, forward_embedding = false;  ///< Table 1
};

/// Options of paper C's network, the preset `controllers-paper`: ablations (Tables 2-4).
struct ControllersOptions {
  double truth_decay = 0.99995;  ///< decay per step of the share of real frames fed back
  bool residual = false;         ///< ControllersConfig::residual; not in the paper
  bool no_absolute_position = false, no_relative_position = false;
  bool one_lstm = false, condition_fc = false, one_decoder = false, no_velocity_factors = false;
};

/// A range of lengths of transitions, frames, both ends included.
struct LengthRange {
  int least, most;
  bool operator==(const LengthRange&) const = default;
};
/// Paper C's curriculum at a step of `steps`: the longest length grows from `shortest` to `longest`
/// by one frame per epoch, the shortest by four every five epochs. All epochs have the same number
/// of steps.
LengthRange CurriculumAt(int64_t step, int64_t steps, int shortest, int longest);

/// The options of a run of one of the papers' presets.
struct PaperOptions : TrainOptions {
  int shortest = 5, longest = 100;  ///< N of the windows, frames
  bool no_key_loss = false;         ///< of flows and controllers
  FlowOptions flow;
  ControllersOptions controllers;

  bool IsControllers() const { return preset == ControllersConfig::kPreset; }
  bool IsInbetweener() const { return preset == kInbetweenerPreset; }
  std::string Command() const override;
  std::string Fixed() const override;
  void Check() const override;
};

/// VisitFixed for options that only the papers' presets have: `visit(option, value, is_used,
/// what)`; `is_used`: the preset's network uses it.
void VisitFixedOfPapers(auto& options, auto&& visit) {
  const bool controllers = options.IsControllers(), inbetweener = options.IsInbetweener();
  const bool flow = !controllers && !inbetweener;
  visit("--shortest", options.shortest, true, "Shortest training transition, frames");
  visit("--longest", options.longest, true, "Longest training transition, frames");
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

/// Trains paper F's flow (`paper`, `paper-f`, `ablation`). Output and errors are
/// TrainContinuousFlow's, also below.
void TrainFlow(const PaperOptions& options);
/// Trains the baseline of both papers, with TrainFlow's windows, on the CPU.
void TrainInbetweener(const PaperOptions& options);
/// Trains paper C's network, with a curriculum of lengths.
void TrainControllers(const PaperOptions& options);

}  // namespace choreo
