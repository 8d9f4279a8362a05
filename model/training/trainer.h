#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace choreo {

/// Frames from key to key at which models are compared: those of paper F, Table 2, and ten.
inline constexpr std::array kComparedFrames{10, 30, 60, 90};
/// The same of paper C's network (paper C, Tables 2-4).
inline constexpr std::array kControlledFrames{10, 50, 100, 150};

/// One training run. Everything that makes it is here or in the data: the same options give the
/// same checkpoint on one machine. Those of the papers' presets know more
/// (model/papers/training/paper_options.h).
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

  virtual ~TrainOptions() = default;
  /// What a stranger types to train the same: folders by their names alone.
  virtual std::string Command() const;
  /// What must not change when a run is resumed: all of Command() but names and places.
  virtual std::string Fixed() const;
  /// Throws Error(kInvalidArgument) naming the option.
  virtual void Validate() const;
};

/// Throws Error(kInvalidArgument, option) unless it is `good`: "VALUE, but it must be LIMIT".
void Require(bool good, const char* option, const std::string& value, const std::string& limit);

/// Calls `visit(option, value, what)` of each option of every preset, --preset and --from aside,
/// that a run must keep.
void VisitFixed(auto& options, auto&& visit) {
  visit("--steps", options.steps, "Steps of the run");
  visit("--batch", options.batch, "Windows a step");
  visit("--rate", options.rate, "Peak learning rate");
  visit("--clip", options.clip, "Norm that gradients are clipped to; 0: never");
  visit("--tempo", options.tempo,
        "Share of the windows that are danced up to a third faster or slower");
  visit("--seed", options.seed, "Same seed, data and machine: same checkpoint");
}
/// The same of the preset `default` alone.
void VisitFixedOfDefault(auto& options, auto&& visit) {
  visit("--keep-statistics", options.keep_statistics,
        "With --from: what that measured of its data stays, and what it does not know is measured");
}

/// Writes options down as they are typed: a visitor for VisitFixed.
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

/// Trains the continuous flow, showing a progress bar. Writes run/state.safetensors (resumable to
/// the bit after a kill at any time), curves.csv, plots of it, and checkpoint.safetensors, which
/// has the moving average of the weights, with its card, at each report and at the end. Throws
/// Error(kInvalidArgument) naming the option that can't be used.
void TrainContinuousFlow(const TrainOptions& options);

}  // namespace choreo
