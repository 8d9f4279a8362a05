#include "model/engine/warm_up.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

#include "model/core/quantile.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

constexpr int kFrames = 60;  // of a transition: two seconds, as between two keys
constexpr int kSteps = 12;   // of those
constexpr int kTogether = 16;

double SecondsOf(const std::function<void()>& action) {
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
  spec.frames = std::min(kFrames, model.max_transition_frames);
  spec.history.assign(static_cast<size_t>(model.history_frames), RestPose(model.skeleton));
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

}  // namespace choreo
