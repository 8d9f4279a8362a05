#include "model/plan/transition_spec.h"

#include <algorithm>
#include <string>
#include <utility>

#include "model/core/error.h"
#include "model/core/range.h"
#include "model/motion/pose/pose_limits.h"

namespace choreo {
namespace {

void CheckRows(const Eigen::MatrixXf& rows, int count, const ModelInfo& model,
               const std::string& field) {
  if (rows.rows() == model.music_features.count && rows.cols() == count) return;
  throw InvalidArgument(field, std::to_string(rows.rows()) + " x " + std::to_string(rows.cols()) +
                                   ", must be " + std::to_string(model.music_features.count) +
                                   " x " + std::to_string(count));
}

void CheckTarget(const Target& target, const ModelInfo& model, const std::string& field) {
  CheckJoints(model.skeleton, target.pose, field);
  const size_t masked = target.mask.joints.size();
  if (masked != 0 && static_cast<int>(masked) != model.skeleton.joints()) {
    throw InvalidArgument(field + ".mask", std::to_string(masked) + " joints, must be 0 or " +
                                               std::to_string(model.skeleton.joints()));
  }
}

}  // namespace

bool Keyed(const TransitionSpec& spec) {
  if (!spec.target) return false;
  const PoseMask& mask = spec.target->mask;
  return mask.root_position || mask.joints.empty() ||
         std::ranges::any_of(mask.joints, [](bool fixed) { return fixed; });
}

std::optional<Arrival> ArrivalOf(const TransitionSpec& spec, Arrival::Lead lead) {
  if (!spec.target || spec.arrival_frames <= 0) return std::nullopt;
  return Arrival(spec.arrival_frames, spec.frames, *spec.target, spec.history, spec.after, lead);
}

ValidSpec::ValidSpec(TransitionSpec request, const ModelInfo& model) : Valid(std::move(request)) {
  const TransitionSpec& spec = **this;
  if (spec.frames < 1 || spec.frames > model.max_transition_frames) {
    throw InvalidArgument("frames", std::to_string(spec.frames) + " is not in [1, " +
                                        std::to_string(model.max_transition_frames) + "]");
  }
  const int tau = model.history_frames;
  if (static_cast<int>(spec.history.size()) != tau) {
    throw InvalidArgument(
        "history", std::to_string(spec.history.size()) + " poses, must be " + std::to_string(tau));
  }
  for (size_t i = 0; i < spec.history.size(); ++i) {
    CheckJoints(model.skeleton, spec.history[i], "history[" + std::to_string(i) + "]");
  }
  if (spec.target) CheckTarget(*spec.target, model, "target");
  if (spec.later) CheckTarget(spec.later->target, model, "later");
  if (spec.after) {
    CheckJoints(model.skeleton, *spec.after, "after");
    if (!spec.target) throw InvalidArgument("after", "needs a target");
  }
  if (spec.music && model.music_features) {
    CheckRows(spec.music->history, tau, model, "audio_history");
    CheckRows(spec.music->rows, spec.frames, model, "audio_rows");
  }
  const size_t like = spec.noise_like.size();
  if (like != 0 && static_cast<int>(like) != spec.frames) {
    throw InvalidArgument("noise_like", std::to_string(like) + " frames, must be 0 or " +
                                            std::to_string(spec.frames));
  }
  spec.controls.Check(model.controls, model.name, spec.frames);
  Range{0, kMaxTemperature}.Check(spec.temperature, "temperature");
  CheckStyle(model, spec.style);
}

}  // namespace choreo
