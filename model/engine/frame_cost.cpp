#include "model/engine/frame_cost.h"

#include <algorithm>

namespace choreo {
namespace {

/// What is left of a sum when the next value comes: the last hundred steps and twenty transitions
/// count, be they of one second or of an hour.
constexpr double kStepsFade = 0.99;
constexpr double kTransitionsFade = 0.95;
/// As many of each as the warm-up stands for.
constexpr double kWarmSteps = 100;
constexpr double kWarmFrames = 20 * 60;

}  // namespace

FrameCost::FrameCost(const EngineCost& measured, int most)
    : measured_(measured),
      most_(most),
      steps_(kWarmSteps * measured.alone),
      expected_steps_(steps_),
      admissions_(kWarmFrames * measured.admission),
      admitted_frames_(kWarmFrames) {}

double FrameCost::StepOf(double slots) const {
  const double more = std::max(0.0, measured_.together - measured_.alone);
  return measured_.alone + more * (slots - 1) / std::max(1, measured_.slots - 1);
}

void FrameCost::AddStep(int slots, double seconds) {
  const std::lock_guard lock(mutex_);
  steps_ = kStepsFade * steps_ + seconds;
  expected_steps_ = kStepsFade * expected_steps_ + StepOf(slots);
}

void FrameCost::AddTransition(double admission_seconds, int frames) {
  const std::lock_guard lock(mutex_);
  admissions_ = kTransitionsFade * admissions_ + admission_seconds;
  admitted_frames_ = kTransitionsFade * admitted_frames_ + std::max(1, frames);
}

double FrameCost::LoadOf(double frames_per_second, double fps) const {
  const double transitions = frames_per_second / fps;
  const double batch = std::clamp(transitions, 1.0, static_cast<double>(most_));
  const std::lock_guard lock(mutex_);
  if (measured_.alone <= 0) return 0;
  const double slowness = steps_ / expected_steps_;
  return frames_per_second * (slowness * StepOf(batch) / batch + admissions_ / admitted_frames_);
}

}  // namespace choreo
