#include "model/evaluation/interpolation_engine.h"

#include <algorithm>
#include <utility>

#include "model/core/error.h"
#include "model/motion/resample.h"

namespace choreo {

InterpolationEngine::InterpolationEngine(ModelInfo model, int slots)
    : model_(std::move(model)), slots_(static_cast<size_t>(slots)) {
  model_.name = model_.fingerprint = "interpolation";
}

int InterpolationEngine::free_slots() const {
  return static_cast<int>(
      std::ranges::count_if(slots_, [](const auto& slot) { return !slot.has_value(); }));
}

int InterpolationEngine::Admit(const TransitionSpec& spec) {
  ValidateSpec(spec, model_);
  const auto free =
      std::ranges::find_if(slots_, [](const auto& slot) { return !slot.has_value(); });
  if (free == slots_.end()) throw Error(ErrorCode::kResourceExhausted, "", "every slot is taken");
  const Pose& from = spec.history.back();
  *free =
      Way{from, spec.target ? spec.target->pose : from, spec.frames, 0, spec.controls.root_path};
  return static_cast<int>(free - slots_.begin());
}

void InterpolationEngine::Step(std::span<const StepInput> in, std::span<StepOutput> out) {
  for (size_t i = 0; i < in.size(); ++i) {
    Way& way = *slots_[static_cast<size_t>(in[i].slot)];
    out[i] = {};
    out[i].pose = InterpolatePoses(way.from, way.to, (way.done + 1.0) / way.frames);
    if (way.path.cols() > 0) out[i].pose.root_position = way.path.col(way.done).cast<double>();
    ++way.done;
  }
}

}  // namespace choreo
