#include "model/engine/engine_cost.h"

#include <algorithm>
#include <chrono>
#include <vector>

#include "model/core/grid.h"
#include "model/core/quantile.h"
#include "model/engine/step_engine.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

/// What is left of a sum when the next value comes: the last hundred steps and twenty transitions
/// count, be they of one second or of an hour.
constexpr double kStepsFade = 0.99;
constexpr double kTransitionsFade = 0.95;
/// As many of each as the warm-up stands for.
constexpr double kWarmSteps = 100;
constexpr double kWarmFrames = 20 * kUsualFrames;

constexpr int kSteps = 12;  // of those
constexpr int kTogether = 16;
constexpr double kBeatSeconds = 0.5;

double SecondsOf(const auto& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct Measured {
  double admission_s, step_s;  ///< medians
};

// As many transitions, step by step.
Measured Dance(StepEngine& engine, int count) {
  const ModelInfo& model = engine.model();
  TransitionSpec spec;
  spec.frames = std::min(kUsualFrames, model.max_transition_frames);
  spec.history.assign(static_cast<size_t>(model.history_frames), RestPose(model.skeleton));
  // As music has them: a model that is guided by them is asked twice.
  for (double beat = 0; beat <= spec.frames; beat += kBeatSeconds * model.fps)
    spec.beats.push_back(beat);
  std::vector<double> admissions, steps;
  std::vector<StepInput> in(static_cast<size_t>(count));
  for (StepInput& input : in) {
    admissions.push_back(SecondsOf([&] { input.slot = engine.Admit(spec); }));
  }
  std::vector<StepOutput> out(in.size());
  std::vector<Pose> previous(in.size());
  for (int frame = 0; frame < std::min(kSteps, spec.frames); ++frame) {
    steps.push_back(SecondsOf([&] { engine.Step(in, out); }));
    for (size_t i = 0; i < in.size(); ++i) {
      previous[i] = std::move(out[i].pose);
      in[i].previous = &previous[i];
    }
  }
  for (const StepInput& input : in) engine.Release(input.slot);
  return {Median(admissions) / spec.frames, Median(steps)};
}

}  // namespace

void WarmUp(StepEngine& engine) {
  const int together = std::min({kTogether, engine.batch(), engine.free_slots()});
  Dance(engine, 1);  // what is done once is not measured
  const Measured one = Dance(engine, 1);
  const Measured all = Dance(engine, together);
  engine.set_cost({.admission = all.admission_s,
                   .alone = one.step_s,
                   .together = all.step_s,
                   .slots = together});
}

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
