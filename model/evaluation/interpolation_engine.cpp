#include "model/evaluation/interpolation_engine.h"

#include <utility>

#include "model/motion/resample.h"

namespace choreo {
namespace {

ModelInfo Named(ModelInfo model) {
  model.name = model.fingerprint = "interpolation";
  return model;
}

}  // namespace

InterpolationEngine::InterpolationEngine(ModelInfo model, int slots)
    : SlotEngine(Named(std::move(model)), "cpu", slots) {}

InterpolatedTransition InterpolationEngine::Begin(const TransitionSpec& spec, int /*slot*/) {
  const Pose& from = spec.history.back();
  return {from, spec.target ? spec.target->pose : from, spec.frames, 0, spec.controls.root_path};
}

void InterpolationEngine::StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) {
  for (size_t i = 0; i < in.size(); ++i) {
    InterpolatedTransition& way = At(in[i]);
    out[i] = {};
    out[i].pose = InterpolatePoses(way.from, way.to, (way.done + 1.0) / way.frames);
    if (way.path.cols() > 0) out[i].pose.root_position = way.path.col(way.done);
    ++way.done;
  }
}

}  // namespace choreo
