#include "model/evaluation/windows.h"

#include <algorithm>
#include <cstdint>

namespace choreo {
namespace {

constexpr int kBeatMargin = 60;  // frames around a transition, whose timing looks to both sides

}  // namespace

std::vector<double> BeatsBetween(const std::vector<double>& beats, int start, int frames) {
  std::vector<double> within;
  for (const double beat : beats) {
    if (beat >= start && beat < start + frames) within.push_back(beat - start);
  }
  return within;
}

bool ClipSet::HasMusic() const {
  return std::ranges::any_of(clips, [](const auto& clip) { return clip.audio.cols() > 0; });
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

TransitionInput InputOf(const ModelInfo& model, const ClipSet& set, const EvalWindow& window,
                        int frames, float temperature, size_t number) {
  const PreparedClip& clip = set.clips[window.clip];
  const auto first = clip.motion.frames.begin() + window.start;
  TransitionInput input;
  input.request.frames = frames;
  input.request.history.assign(first - model.history_frames, first);
  input.request.target = Target{first[frames - 1], {}};
  input.request.temperature = temperature;
  input.request.seed = number;
  input.request.beats =
      set.BeatsBetween(window.clip, window.start - kBeatMargin, frames + 2 * kBeatMargin);
  for (double& beat : input.request.beats) beat -= kBeatMargin;
  if (clip.audio.cols() > 0 && model.audio_features > 0) {
    input.request.has_audio = true;
    input.request.audio_history =
        clip.audio.middleCols(window.start - model.history_frames, model.history_frames);
    input.audio_rows = clip.audio.middleCols(window.start, frames);
  }
  return input;
}

std::vector<Pose> RealPoses(const ClipSet& set, const EvalWindow& window, int frames, int before) {
  const auto first = set.clips[window.clip].motion.frames.begin() + window.start;
  return {first - before, first + frames};
}

}  // namespace choreo
