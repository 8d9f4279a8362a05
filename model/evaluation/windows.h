#pragma once

#include <string>
#include <vector>

#include "model/dance/transition/transition.h"
#include "model/training/clips/prepared_clip.h"

namespace choreo {

/// Held-out clips of one data set, on one skeleton.
struct ClipSet {
  std::string name;  ///< of the data's folder
  std::vector<PreparedClip> clips;
  /// The beats of each clip's music, in frames of its motion, ascending (song_beats.h). May be
  /// shorter than `clips`: the other clips' beats are unknown.
  std::vector<std::vector<double>> beats = {};

  /// choreo::BeatsBetween of the beats of `clip`. Empty if they are unknown.
  std::vector<double> BeatsBetween(size_t clip, int start, int frames) const;
};

/// The `beats`, in frames, that are in [start, start + frames), counted from start.
std::vector<double> BeatsBetween(const std::vector<double>& beats, int start, int frames);

/// A real transition: frames [start, start + frames) of the clip, after its history.
struct EvalWindow {
  size_t clip = 0;  ///< within its set
  int start = 0;
};

/// Chooses at most `per_clip` windows that do not overlap, each in the middle of an equal part of
/// its clip, away from the clip's ends, where dancers stand. None from a clip that is too short.
std::vector<EvalWindow> ChooseWindows(const ClipSet& set, int history, int frames, int per_clip);

/// The request for a window, with its real key and its clip's music, if any. The window's `number`
/// is the seed.
TransitionSpec RequestOf(const ModelInfo& model, const ClipSet& set, const EvalWindow& window,
                         int frames, float temperature, size_t number);

/// The real dance in a window, preceded by `before` frames of history.
std::vector<Pose> RealPoses(const ClipSet& set, const EvalWindow& window, int frames, int before);

}  // namespace choreo
