#include "model/engine/step_engine.h"

#include <algorithm>

#include "model/core/error.h"

namespace choreo {
namespace {

template <typename Matrix>
void CheckControl(const Matrix& values, bool taken, int frames, const ModelInfo& model,
                  const std::string& field) {
  if (values.cols() == 0) return;
  if (!taken) throw InvalidArgument(field, "the model '" + model.name + "' does not take it");
  if (values.cols() != frames) {
    throw InvalidArgument(
        field, std::to_string(values.cols()) + " frames, must be " + std::to_string(frames));
  }
  if (!values.allFinite()) throw InvalidArgument(field, "not finite");
}

}  // namespace

void CheckJoints(const Skeleton& skeleton, const Pose& pose, const std::string& field) {
  if (pose.rotations.cols() == skeleton.joints()) return;
  throw InvalidArgument(field + ".rotations", std::to_string(pose.rotations.cols()) +
                                                  " joints, the model has " +
                                                  std::to_string(skeleton.joints()));
}

bool Keyed(const TransitionSpec& spec) {
  if (!spec.target) return false;
  const PoseMask& mask = spec.target->mask;
  return mask.root_position || mask.joints.empty() ||
         std::ranges::any_of(mask.joints, [](bool asked) { return asked; });
}

void ValidateSpec(const TransitionSpec& spec, const ModelInfo& model) {
  if (spec.frames < 1 || spec.frames > model.max_transition_frames) {
    throw InvalidArgument("frames", std::to_string(spec.frames) + " is not in [1, " +
                                        std::to_string(model.max_transition_frames) + "]");
  }
  const int history = model.history_frames;
  if (static_cast<int>(spec.history.size()) != history) {
    throw InvalidArgument("history", std::to_string(spec.history.size()) + " poses, must be " +
                                         std::to_string(history));
  }
  for (size_t i = 0; i < spec.history.size(); ++i) {
    CheckJoints(model.skeleton, spec.history[i], "history[" + std::to_string(i) + "]");
  }
  if (spec.target) {
    CheckJoints(model.skeleton, spec.target->pose, "target");
    const size_t masked = spec.target->mask.joints.size();
    if (masked != 0 && static_cast<int>(masked) != model.skeleton.joints()) {
      throw InvalidArgument("target.mask", std::to_string(masked) + " joints, must be 0 or " +
                                               std::to_string(model.skeleton.joints()));
    }
  }
  if (spec.has_audio &&
      (spec.audio_history.rows() != model.audio_features || spec.audio_history.cols() != history)) {
    throw InvalidArgument("audio_history", std::to_string(spec.audio_history.rows()) + " x " +
                                               std::to_string(spec.audio_history.cols()) +
                                               ", must be " + std::to_string(model.audio_features) +
                                               " x " + std::to_string(history));
  }
  const Controls& controls = spec.controls;
  CheckControl(controls.root_path, model.root_path, spec.frames, model, "controls.root_path");
  CheckControl(controls.velocity_factors, model.velocity_factors, spec.frames, model,
               "controls.velocity_factors");
  if (controls.velocity_factors.size() > 0 && controls.velocity_factors.minCoeff() < 0) {
    throw InvalidArgument(
        "controls.velocity_factors",
        std::to_string(controls.velocity_factors.minCoeff()) + " m a frame, must be at least 0");
  }
}

int StepEngine::Admit(const TransitionSpec& spec) {
  const int slot = BeginAdmission(spec);
  try {
    while (ContinueAdmission(slot)) {
    }
  } catch (...) {
    Release(slot);
    throw;
  }
  return slot;
}

void ValidateStep(const StepInput& input, const std::optional<SlotProgress>& progress,
                  const ModelInfo& model) {
  if (!progress) throw InvalidArgument("slot", std::to_string(input.slot) + " holds no transition");
  if (progress->being_admitted)
    throw InvalidArgument("slot", std::to_string(input.slot) + " is still being admitted");
  if (progress->frame >= progress->frames) {
    throw InvalidArgument("slot", std::to_string(input.slot) + " has made its " +
                                      std::to_string(progress->frames) + " frames already");
  }
  if ((progress->frame > 0) != (input.previous != nullptr)) {
    throw InvalidArgument("previous", progress->frame > 0 ? "is missing after the first frame"
                                                          : "is given before the first frame");
  }
  if (input.previous != nullptr) CheckJoints(model.skeleton, *input.previous, "previous");
  if (progress->hears && static_cast<int>(input.audio_row.size()) != model.audio_features) {
    throw InvalidArgument("audio_row", std::to_string(input.audio_row.size()) +
                                           " values, must be " +
                                           std::to_string(model.audio_features));
  }
}

}  // namespace choreo
