#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace choreo {

/// One training run. Everything that makes it is here or in the data: the same options give the
/// same checkpoint on one machine.
struct TrainOptions {
  std::string preset = "default";
  std::string name;                         ///< as servers list the model; empty: the preset's
  std::vector<std::filesystem::path> data;  ///< folders of prepared clips
  std::filesystem::path splits;             ///< JSON, see ClipStore
  std::filesystem::path from;    ///< checkpoint whose network it starts from; empty: from scratch
  std::filesystem::path run;     ///< folder for state, curves and the finished checkpoint
  std::string device = "cpu";    ///< "cpu" or "cuda:N"
  bool with_validation = false;  ///< train on validation clips too: a last run, once all is chosen
  bool resume = false;           ///< go on from the run's state if there is one
  int64_t steps = 14000;
  int batch = 64;                   ///< windows a step; longer windows get fewer, at equal frames
  double rate = 1e-3;               ///< peak learning rate; warm-up, then cosine to a twentieth
  int shortest = 5, longest = 100;  ///< N of the training windows, frames
  int rollout_frames = 30;          ///< gamma of paper F
  double tempo = 0.5;          ///< share of the windows danced faster or slower (preset default)
  int64_t report_every = 250;  ///< steps between validation, curves and saved state
  int64_t stop_after = 0;      ///< leave after this many steps of the run, resumable; 0: to the end
  uint64_t seed = 1;
  /// kAblations.
  bool no_keys = false, no_key_loss = false, no_time_embedding = false, forward_embedding = false;
  bool one_lstm = false, condition_fc = false, one_decoder = false, no_velocity_factors = false;

  /// What a stranger types to train the same: folders by their names alone.
  std::string Command() const;
  /// What must not change when a run is resumed: all of Command() but names and places.
  std::string Fixed() const;
  /// Throws Error(kInvalidArgument) naming the option.
  void Validate() const;
};

/// A switch that leaves something out (paper F, Table 1; paper C, Tables 2-4).
struct Ablation {
  const char* option;
  bool TrainOptions::*on;
  bool of_flows, of_controllers;  ///< which networks have it
  const char* what;
};
inline constexpr Ablation kAblations[] = {
    {"--no-keys", &TrainOptions::no_keys, true, false, "Ablation: music alone"},
    {"--no-key-loss", &TrainOptions::no_key_loss, true, true, "Ablation: no key pose loss"},
    {"--no-time-embedding", &TrainOptions::no_time_embedding, true, false,
     "Ablation: no time embedding"},
    {"--forward-embedding", &TrainOptions::forward_embedding, true, false,
     "Ablation: count frames from the start, not frames left"},
    {"--one-lstm", &TrainOptions::one_lstm, false, true, "Ablation of controllers"},
    {"--condition-fc", &TrainOptions::condition_fc, false, true,
     "Ablation of controllers: fully connected instead of transformers"},
    {"--one-decoder", &TrainOptions::one_decoder, false, true, "Ablation of controllers"},
    {"--no-velocity-factors", &TrainOptions::no_velocity_factors, false, true,
     "Ablation of controllers"}};

}  // namespace choreo
