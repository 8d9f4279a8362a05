#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace choreo {

/// Frames between keys at which models are compared: paper F's (Table 2), and 10.
inline constexpr std::array kComparedFrames{10, 30, 60, 90};
/// The same for paper C's network (paper C, Tables 2-4).
inline constexpr std::array kControlledFrames{10, 50, 100, 150};

/// The options of a training run. On one machine, the same options and data give the same
/// checkpoint. The papers' presets add options (model/papers/training/paper_options.h).
struct TrainOptions {
  std::string preset = "default";
  std::string name;  ///< the model's name in servers' lists; empty: the preset's
  std::vector<std::filesystem::path> data;  ///< folders of prepared clips
  std::filesystem::path splits;             ///< JSON, see LoadClips
  std::filesystem::path from;  ///< checkpoint with the initial weights; empty: from scratch
  std::filesystem::path run;   ///< folder for state, curves and the finished checkpoint
  std::string device = "cpu";  ///< "cpu" or "cuda:N"
  /// For continuous flows: keeps the statistics of `from`'s data, and measures only missing ones.
  bool keep_statistics = false;
  /// The share of the trained weights in a continuous flow's checkpoint; the rest is `from`'s
  /// (Wortsman et al. 2022). A finished run rewrites its checkpoint with it.
  double blend = 1;
  bool resume = false;         ///< continue from the run's state if there is one
  int64_t report_every = 250;  ///< steps between validation, curves and saved state
  int64_t stop_after = 0;      ///< stop after this many steps, resumable; 0: run to the end
  int64_t steps = 14000;
  int batch = 64;      ///< windows per step; longer windows get fewer, at equal frames
  double rate = 1e-3;  ///< peak learning rate; warm-up, then cosine to a twentieth
  double clip = 1;     ///< limit of a step's gradient norm; 0: no clipping
  double tempo = 0.5;  ///< share of windows played faster or slower
  uint64_t seed = 1;

  virtual ~TrainOptions() = default;
  /// The command that reproduces the training, with folders by name only.
  virtual std::string Command() const;
  /// The options that a resumed run must repeat: all of Command() except names and paths.
  virtual std::string Fixed() const;
  /// Throws Error(kInvalidArgument), naming the option, for an invalid value.
  virtual void Check() const;
};

/// Throws Error(kInvalidArgument, option) unless `good`: "VALUE, but it must be LIMIT".
void Require(bool good, const char* option, const std::string& value, const std::string& limit);

/// Calls `visit(option, value, what)` for each option of every preset that a resumed run must
/// repeat, except --preset and --from.
void VisitFixed(auto& options, auto&& visit) {
  visit("--steps", options.steps, "Steps of the run");
  visit("--batch", options.batch, "Windows per step");
  visit("--rate", options.rate, "Peak learning rate");
  visit("--clip", options.clip, "Norm that gradients are clipped to; 0: never");
  visit("--tempo", options.tempo, "Share of windows danced up to a third faster or slower");
  visit("--seed", options.seed, "The same seed, data and machine give the same checkpoint");
}
/// The same for the preset `default` alone.
void VisitFixedOfDefault(auto& options, auto&& visit) {
  visit("--keep-statistics", options.keep_statistics,
        "With --from: keep its statistics of the data, and measure only missing ones");
}

/// A visitor for VisitFixed that writes options as typed on a command line.
class OptionText {
 public:
  void operator()(const char* option, const auto& value, const char* /*what*/) {
    if constexpr (!std::is_same_v<decltype(value), const bool&>) {
      values_ << ' ' << option << ' ' << value;
    } else if (value) {
      flags_ += std::string(" ") + option;
    }
  }
  std::string Text() const { return values_.str() + flags_; }

 private:
  std::ostringstream values_;
  std::string flags_;
};

/// Trains the continuous flow, showing a progress bar. Writes run/state.safetensors (a killed run
/// resumes to the bit), curves.csv and its plots, and, at each report and at the end,
/// checkpoint.safetensors with the moving average of the weights and its card. Throws
/// Error(kInvalidArgument) naming an unusable option.
void TrainContinuousFlow(const TrainOptions& options);

}  // namespace choreo
