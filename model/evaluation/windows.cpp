#include "model/evaluation/windows.h"

#include <algorithm>
#include <cstdint>

namespace choreo {

std::vector<double> BeatsBetween(const std::vector<double>& beats, int start, int frames) {
  std::vector<double> within;
  for (const double beat : beats) {
    if (beat >= start && beat < start + frames) within.push_back(beat - start);
  }
  return within;
}

std::vector<double> ClipSet::BeatsBetween(size_t clip, int start, int frames) const {
  return clip < beats.size() ? choreo::BeatsBetween(beats[clip], start, frames)
                             : std::vector<double>();
}

std::vector<EvalWindow> ChooseWindows(const ClipSet& set, int history, int frames, int per_clip) {
  std::vector<EvalWindow> windows;
  for (size_t clip = 0; clip < set.clips.size(); ++clip) {
    const int spare = static_cast<int>(set.clips[clip].motion.frames.size()) - history - frames;
    if (spare < 0) continue;
    const int count = std::min(per_clip, 1 + spare / frames);
    for (int w = 0; w < count; ++w) {
      const auto middle = static_cast<int>(int64_t{spare + frames} * (2 * w + 1) / (2 * count));
      windows.push_back({clip, history + middle - frames / 2});
    }
  }
  return windows;
}

TransitionSpec RequestOf(const ModelInfo& model, const ClipSet& set, const EvalWindow& window,
                         int frames, float temperature, size_t number) {
  constexpr int kBeatMargin = 60;  // frames around a transition, whose timing looks to both sides
  const PreparedClip& clip = set.clips[window.clip];
  const auto first = clip.motion.frames.begin() + window.start;
  const int history = model.history_frames;
  TransitionSpec spec;
  spec.frames = frames;
  spec.history.assign(first - history, first);
  spec.target = Target{first[frames - 1], {}};
  spec.temperature = temperature;
  spec.seed = number;
  spec.beats = set.BeatsBetween(window.clip, window.start - kBeatMargin, frames + 2 * kBeatMargin);
  for (double& beat : spec.beats) beat -= kBeatMargin;
  if (clip.audio.cols() > 0 && model.music_features) {
    spec.music = {clip.audio.middleCols(window.start - history, history),
                  clip.audio.middleCols(window.start, frames)};
  }
  return spec;
}

std::vector<Pose> RealPoses(const ClipSet& set, const EvalWindow& window, int frames, int before) {
  const auto first = set.clips[window.clip].motion.frames.begin() + window.start;
  return {first - before, first + frames};
}

}  // namespace choreo
