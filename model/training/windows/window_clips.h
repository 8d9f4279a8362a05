#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/core/numbers/random.h"
#include "model/training/clips/clip_track.h"
#include "model/training/windows/window_batch.h"
#include "model/training/windows/window_picker.h"

namespace choreo {

/// Draws training windows from prepared clips with their labels: energy of body parts, root path,
/// beats, style. Immutable after construction; thread-safe.
class WindowClips {
 public:
  explicit WindowClips(const std::vector<PreparedClip>& clips);

  /// The probability of each variation in training. All zero: whole keys and no other labels.
  struct Variation {
    double mirror = 0;
    double tempo = 0;  ///< played up to a third faster or slower
    double no_key = 0;
    double partial_key = 0;  ///< joints or the root position are left open
    double beats = 0, energy = 0, path = 0, style = 0;  ///< the label is given
    double stage = 0;                                   ///< the stage is given
    double hold_history = 0;  ///< earlier poses are unknown: they repeat the first of the last few
    double other_style = 0;   ///< begins in another style, if the style label is given
    double even_styles =
        0;  ///< first draws a style, all equally likely; otherwise any place in the clips
    double standing = 0;  ///< begins from StandingPose, as dances do
    double astray = 0;    ///< starts out of balance, as a model's dances do, and recovers
  };
  /// Draws windows of `frames` frames with a key `to_key` frames after the history.
  WindowBatch Draw(const FlowModelParts& model, int batch, int frames, int to_key,
                   const Variation& variation, Random* random) const;

  /// The longest distance, frames, to a key after `history` frames in any clip.
  int Longest(int history) const;
  const Skeleton& skeleton() const { return skeleton_; }
  const std::vector<std::string>& styles() const { return styles_; }
  /// The tracks of the clips at their own tempo.
  std::span<const ClipTrack> tracks() const { return {tracks_.data(), clips_}; }

 private:
  // Pickers of windows among the clips of each style that has long enough clips.
  std::vector<WindowPicker> PickersByStyle(int64_t window) const;

  Skeleton skeleton_;
  std::vector<std::string> styles_;
  std::vector<ClipTrack> tracks_;  // by tempo, the clips' own first
  size_t clips_ = 0;
};

}  // namespace choreo
