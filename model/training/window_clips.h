#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/core/random.h"
#include "model/training/clip_track.h"
#include "model/training/window_batch.h"

namespace choreo {

/// Prepared clips with what they say of themselves: the energy of body parts, their root path,
/// beats, style. Immutable after construction.
class WindowClips {
 public:
  explicit WindowClips(const std::vector<PreparedClip>& clips);

  /// What training varies, each a probability. All zero: whole keys, no other label.
  struct Variation {
    double mirror = 0;
    double tempo = 0;  ///< danced up to a third faster or slower
    double no_key = 0;
    double partial_key = 0;                             ///< joints or the root's position are open
    double beats = 0, energy = 0, path = 0, style = 0;  ///< that the label is told
    double stage = 0;                                   ///< that the stage is known
    double hold_history = 0;  ///< only the last few poses are known, the earliest being held
    double other_style = 0;   ///< begins in another style, where the label is told
    double even_styles = 0;  ///< of a style drawn first, each alike; else of any place in the clips
    double astray = 0;       ///< starts out of balance, as dances of a model do, and comes back
  };
  /// Windows of `frames` frames whose key stands `to_key` frames behind the history.
  WindowBatch Draw(const FlowModelParts& model, int batch, int frames, int to_key,
                   const Variation& variation, Random* random) const;

  /// The longest way to a key behind `history` frames that some clip has.
  int Longest(int history) const;
  const Skeleton& skeleton() const { return skeleton_; }
  const std::vector<std::string>& styles() const { return styles_; }
  /// Of the clips as they were danced.
  std::span<const ClipTrack> tracks() const { return {tracks_.data(), clips_}; }

 private:
  Skeleton skeleton_;
  std::vector<std::string> styles_;
  std::vector<ClipTrack> tracks_;  // by tempo, the clips' own first
  size_t clips_ = 0;
};

}  // namespace choreo
