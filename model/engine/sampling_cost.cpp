#include "model/engine/sampling_cost.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "model/core/grid.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/plan/sampler.h"

namespace choreo {
namespace {

/// Decay of the sums per transition: about the last twenty count.
constexpr double kFades = 0.95;
/// The weight of the warm-up.
constexpr double kWarmFrames = 20 * kTypicalFrames;

constexpr double kBeatSeconds = 0.5;

double SecondsOf(const auto& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

void WarmUp(Sampler& sampler) {
  const ModelInfo& model = sampler.model();
  TransitionSpec spec;
  spec.frames = std::min(kTypicalFrames, model.max_transition_frames);
  spec.history.assign(static_cast<size_t>(model.history_frames), RestPose(model.skeleton));
  // Beats like music's: a model guided by beats is evaluated twice.
  for (double beat = 0; beat <= spec.frames; beat += kBeatSeconds * model.fps)
    spec.beats.push_back(beat);
  const ValidSpec valid(std::move(spec), model);
  const auto sample = [&] { sampler.Sample(valid).Finish(); };
  sample();  // excludes one-time work from the measurement
  sampler.set_seconds_a_frame(SecondsOf(sample) / valid->frames);
}

SamplingCost::SamplingCost(double seconds_a_frame)
    : seconds_(kWarmFrames * seconds_a_frame), frames_(kWarmFrames) {}

void SamplingCost::Add(double seconds, int frames) {
  const std::lock_guard lock(mutex_);
  if (seconds_ <= 0) return;  // stays unknown if the warm-up measured nothing
  seconds_ = kFades * seconds_ + seconds;
  frames_ = kFades * frames_ + frames;
}

double SamplingCost::LoadOf(double frames_per_second) const {
  const std::lock_guard lock(mutex_);
  return frames_per_second * seconds_ / frames_;
}

}  // namespace choreo
