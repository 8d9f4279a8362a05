#pragma once

#include <array>

#include "model/training/trainer/trainer.h"
#include "model/training/windows/window_clips.h"

namespace choreo {

/// The settings of training `default` that are not options of the command line (TrainOptions).
/// Numbers in brackets are the decisions (docs/decisions.md) behind a setting; its value was not
/// compared with others.
struct FlowTraining {
  /// Lengths of windows, frames: few, because each needs data of its own [64].
  std::array<int, 17> lengths = {5, 8, 10, 15, 20, 25, 30, 36, 42, 48, 54, 60, 66, 72, 80, 90, 96};
  double average = 0.999;  ///< the share of the weights' moving average kept per step

  // Kinds of steps; the others have a key at the window's end.
  double no_key = 0.3;                ///< share without a key [93, 157] ...
  int no_key_frames = 30;             ///< ... with windows at least this long
  double far_key = 0.12;              ///< share with a key beyond the window (kSightFrames) ...
  int far_frames = 72;                ///< ... which has this many frames ...
  int far_step = 24, far_places = 5;  ///< ... and a key 0 to 4 steps before kSightFrames
  double no_labels = 0.35;            ///< share without beats, path and style, for guidance [87]

  /// Shares of windows. `energy`: given, as in the server, which samples it first [66, 78].
  /// `stage`: [93]. `astray`: begins out of balance, as dances may, and recovers.
  WindowClips::Variation shares = {.mirror = 0.5,
                                   .partial_key = 0.12,
                                   .beats = 0.8,
                                   .energy = 0.9,
                                   .path = 0.2,
                                   .style = 0.8,
                                   .stage = 0.8,
                                   .hold_history = 0.05,
                                   .other_style = 0.6,
                                   .even_styles = 0.5,
                                   .standing = 0.05,
                                   .astray = 0.2};

  // Sizes of measurements: windows per batch, and batches for the prior and the energy [66, 78],
  // for turns (few are large) [112], and for the response [131].
  int measured_windows = 48;
  int prior_batches = 12, turn_batches = 120, response_batches = 4;
  std::array<int, 3> energy_frames = {20, 60, 90};
  int validation_windows = 24;
};

/// TrainContinuousFlow of trainer.h with other settings than the default's.
void TrainContinuousFlow(const TrainOptions& options, const FlowTraining& training);

}  // namespace choreo
