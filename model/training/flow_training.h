#pragma once

#include <array>

#include "model/training/window_clips.h"

namespace choreo {

/// How `default` is trained, besides what the command line sets (TrainOptions). Numbers in brackets
/// are the decisions (docs/decisions.md) that need a value; the values themselves are choices that
/// no measurement compared.
struct FlowTraining {
  /// Frames of the windows: few lengths, so that data per length is made once [64].
  std::array<int, 17> lengths = {5, 8, 10, 15, 20, 25, 30, 36, 42, 48, 54, 60, 66, 72, 80, 90, 96};
  double average = 0.999;  ///< what the moving average of the weights keeps per step

  // Kinds of steps; the others have a key at the window's end.
  double no_key = 0.3;                ///< share without a key [93, 157] ...
  int no_key_frames = 30;             ///< ... with windows at least this long
  double far_key = 0.12;              ///< share with a key beyond the window (kSightFrames) ...
  int far_frames = 72;                ///< ... which has so many frames ...
  int far_step = 24, far_places = 5;  ///< ... and the key is this much nearer, so many times
  double no_labels = 0.35;            ///< share without beats, path and style, for guidance [87]

  /// Shares of windows. Energy: given as when serving, where it is sampled first [66, 78]; stage
  /// [93]; astray: dances go there, and must know the way back.
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

  // Sizes of what is measured: windows of a batch, and batches for the prior and the energy [66,
  // 78], for turns [112], of which there are few large ones, and for the response [131].
  int measured_windows = 48;
  int prior_batches = 12, turn_batches = 120, response_batches = 4;
  std::array<int, 3> energy_frames = {20, 60, 90};
  int validation_windows = 24;
};

}  // namespace choreo
