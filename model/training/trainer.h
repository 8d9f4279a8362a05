#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "model/controllers/controllers_config.h"
#include "model/flow/flow_config.h"

namespace CLI {
class App;
}

namespace choreo {

/// Frames from key to key at which models are compared: those of paper F, Table 2, and ten.
inline constexpr std::array kComparedFrames{10, 30, 60, 90};
/// The same of paper C's network (paper C, Tables 2-4).
inline constexpr std::array kControlledFrames{10, 50, 100, 150};

/// Of paper F's flows, the presets `paper`, `paper-f` and `ablation`.
struct FlowOptions {
  int flow_steps = 0, hidden = 0;  ///< K, width of the LSTMs; 0: the preset's
  int condition_width = -1;        ///< of the shared encoding, 0: none; -1: the preset's
  double rollout_share = 1;        ///< of a step's windows, that are sampled for L_key and L_feet
  int64_t rollout_from = 0;  ///< step at which L_key and L_feet begin; before it samples are noise
  double rollout_loss = 0;   ///< weight of the sampled way's distance from the real one, ours
  double temperature = 1;    ///< at which it is served unless asked otherwise
  double dequantise = 0.05;  ///< noise of the likelihood's features, share of their spread
  bool no_innovations = false;  ///< draws features as the paper does, whatever the preset
  bool no_keys = false, no_time_embedding = false, forward_embedding = false;  ///< Table 1
};

/// Of paper C's network, the preset `controllers-paper`: what is left out (Tables 2-4).
struct ControllersOptions {
  double truth_decay = 0.99995;  ///< of the real frames' share of what is fed back, a step
  bool residual = false;         ///< ControllersConfig::residual, ours
  bool no_absolute_position = false, no_relative_position = false;
  bool one_lstm = false, condition_fc = false, one_decoder = false, no_velocity_factors = false;
};

/// One training run. Everything that makes it is here or in the data: the same options give the
/// same checkpoint on one machine.
struct TrainOptions {
  std::string preset = "default";
  std::string name;                         ///< as servers list the model; empty: the preset's
  std::vector<std::filesystem::path> data;  ///< folders of prepared clips
  std::filesystem::path splits;             ///< JSON, see LoadClips
  std::filesystem::path from;  ///< checkpoint whose network it starts from; empty: from scratch
  std::filesystem::path run;   ///< folder for state, curves and the finished checkpoint
  std::string device = "cpu";  ///< "cpu" or "cuda:N"
  /// With `from`, of continuous flows: what it measured of its data stays; what it does not know is
  /// measured.
  bool keep_statistics = false;
  bool resume = false;         ///< go on from the run's state if there is one
  int64_t report_every = 250;  ///< steps between validation, curves and saved state
  int64_t stop_after = 0;      ///< leave after this many steps of the run, resumable; 0: to the end
  int64_t steps = 14000;
  int batch = 64;      ///< windows a step; longer windows get fewer, at equal frames
  double rate = 1e-3;  ///< peak learning rate; warm-up, then cosine to a twentieth
  double clip = 1;     ///< most that a step's gradient may measure; 0: it is never clipped
  double tempo = 0.5;  ///< share of the windows danced faster or slower
  uint64_t seed = 1;
  int shortest = 5, longest = 100;  ///< N of the windows, frames; of all but the continuous flow
  bool no_key_loss = false;         ///< of both, too
  FlowOptions flow;
  ControllersOptions controllers;

  bool IsControllers() const { return preset == ControllersConfig::kPreset; }
  bool IsInbetweener() const { return preset == kInbetweenerPreset; }
  bool IsContinuousFlow() const { return preset == "default"; }
  /// What a stranger types to train the same: folders by their names alone.
  std::string Command() const;
  /// What must not change when a run is resumed: all of Command() but names and places.
  std::string Fixed() const;
  /// Throws Error(kInvalidArgument) naming the option.
  void Validate() const;
};

/// Trains paper F's flow (`paper`, `paper-f`, `ablation`), showing a progress bar. Writes
/// run/state.safetensors (resumable to the bit after a kill at any time), curves.csv, plots of it,
/// and checkpoint.safetensors with its card, at each report and at the end. Throws
/// Error(kInvalidArgument) naming the option that can't be used.
void TrainFlow(const TrainOptions& options);
/// The same of the baseline of both papers, on the windows of TrainFlow and on the CPU.
void TrainInbetweener(const TrainOptions& options);
/// The same of paper C's network, on a curriculum of lengths.
void TrainControllers(const TrainOptions& options);
/// The same of the continuous flow. Its checkpoint has the moving average of the weights.
void TrainContinuousFlow(const TrainOptions& options);

/// `choreo-lab train`. `read_device`: the device ("cpu", "cuda:N") that the text of --device stands
/// for; throws Error for one that is not there.
void AddTrainCommand(CLI::App& app,
                     const std::function<std::string(const std::string&)>& read_device);

}  // namespace choreo
