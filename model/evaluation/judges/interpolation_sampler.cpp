#include "model/evaluation/judges/interpolation_sampler.h"

#include <utility>

#include "model/motion/resample.h"

namespace choreo {
namespace {

ModelInfo Baseline(ModelInfo model) {
  model.name = model.fingerprint = "interpolation";
  model.plan_stages = false;
  return model;
}

}  // namespace

InterpolationSampler::InterpolationSampler(ModelInfo model)
    : Sampler(Baseline(std::move(model)), "cpu") {}

Slices<Plan> InterpolationSampler::Sample(const ValidSpec& valid) {
  const TransitionSpec& spec = *valid;
  const Pose& from = spec.history.back();
  const Pose& to = spec.target ? spec.target->pose : from;
  Plan plan;
  for (int frame = 0; frame < spec.frames; ++frame) {
    Pose& pose = plan.poses.emplace_back(
        InterpolatePoses(from, to, (frame + 1.0) / static_cast<double>(spec.frames)));
    if (spec.controls[kRootPath].IsGiven())
      pose.root_position = spec.controls[kRootPath].values.col(frame);
  }
  co_return plan;
}

}  // namespace choreo
