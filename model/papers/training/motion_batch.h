#pragma once

#include <vector>

#include "model/core/numbers/random.h"
#include "model/papers/networks/transition_tensors.h"
#include "model/papers/training/paper_options.h"
#include "model/training/clips/prepared_clip.h"

namespace choreo {

/// A batch of windows of real motion: tau history frames, then N frames, in the canonical frame of
/// the last history frame.
struct MotionBatch {
  TransitionTensors transition;
  TrajectoryTensors truth;  ///< the N frames
  torch::Tensor features;   ///< [batch, tau + N, width] absolute, by PoseCodec
  torch::Tensor audio;      ///< [batch, tau + N, audio_features], zeros where there is none
  torch::Tensor has_audio;  ///< [batch, 1]

  MotionBatch First(int64_t windows) const;  ///< the first `windows` of the batch, at least one
};

/// Variations in training. All zero: unchanged windows with their key and music.
struct MotionVariation {
  bool mirror = false;
  double drop_key = 0;     ///< probability that a window has no key
  double drop_audio = 0;   ///< probability that its music is masked
  double partial_key = 0;  ///< probability that the key leaves joints or the root's position open
  double tempo = 0;        ///< probability that it is played up to a third faster or slower
  /// Probability that only the last few poses are known; earlier ones repeat the first of these.
  double hold_history = 0;
};
/// Draws `batch` windows of N = `frames` frames after `history` frames from clips of one skeleton.
/// Tensors are on `device`. Throws Error(kInvalidArgument, "frames") if none is long enough.
MotionBatch DrawMotion(const std::vector<PreparedClip>& clips, int batch, int history, int frames,
                       const MotionVariation& variation, torch::Device device, Random* random);

/// Draws the length of a step's windows, between shortest and longest. Half of the draws favour
/// short windows (quadratically), because short transitions are common and cheap.
int DrawnLength(const PaperOptions& options, Random* random);
/// The variations for paper F's flows and for the networks compared with them.
MotionVariation VariationOf(const PaperOptions& options, bool keys);

}  // namespace choreo
