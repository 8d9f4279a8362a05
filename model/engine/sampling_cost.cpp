#include "model/engine/sampling_cost.h"

#include <algorithm>
#include <chrono>

#include "model/core/grid.h"
#include "model/engine/sampler.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

/// What is left of a sum when the next transition comes: the last twenty count.
constexpr double kFades = 0.95;
/// The warm-up stands for as many.
constexpr double kWarmFrames = 20 * kUsualFrames;

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
  spec.frames = std::min(kUsualFrames, model.max_transition_frames);
  spec.history.assign(static_cast<size_t>(model.history_frames), RestPose(model.skeleton));
  // As music has them: a model that is guided by them is asked twice.
  for (double beat = 0; beat <= spec.frames; beat += kBeatSeconds * model.fps)
    spec.beats.push_back(beat);
  sampler.Sample(spec);  // what is done once is not measured
  const double seconds = SecondsOf([&] { sampler.Sample(spec); });
  sampler.set_seconds_a_frame(seconds / spec.frames);
}

SamplingCost::SamplingCost(double seconds_a_frame)
    : seconds_(kWarmFrames * seconds_a_frame), frames_(kWarmFrames) {}

void SamplingCost::Add(double seconds, int frames) {
  const std::lock_guard lock(mutex_);
  if (seconds_ <= 0) return;  // a load that nobody knew at the start is none later
  seconds_ = kFades * seconds_ + seconds;
  frames_ = kFades * frames_ + frames;
}

double SamplingCost::LoadOf(double frames_per_second) const {
  const std::lock_guard lock(mutex_);
  return frames_per_second * seconds_ / frames_;
}

}  // namespace choreo
