#include "model/engine/continuous_flow_engine.h"

#include <algorithm>
#include <utility>

#include "model/core/error.h"
#include "model/engine/plan_timing.h"
#include "model/engine/temperature.h"
#include "model/motion/body_limits.h"

namespace choreo {

WindowRequest ToWindowRequest(const TransitionSpec& spec) {
  WindowRequest request{.frames = spec.frames, .history = spec.history, .to_key = spec.frames};
  if (spec.target) {
    request.key = spec.target->pose;
    request.mask = spec.target->mask;
    if (spec.target->height) {
      request.height = true;
      request.key->root_position.y() = *spec.target->height;
    }
  }
  request.path = spec.controls.root_path.cast<double>();
  request.path_heights = spec.controls.path_heights;
  request.beats = spec.beats;
  request.energy = spec.controls.velocity_factors.cast<double>();
  request.asked = spec.controls.parts_asked;
  return request;
}

ContinuousFlowEngine::ContinuousFlowEngine(ModelInfo info, std::string device, int slots,
                                           std::shared_ptr<const FlowModelParts> parts,
                                           std::shared_ptr<const FlowNetwork> network)
    : info_(std::move(info)),
      device_(std::move(device)),
      parts_(std::move(parts)),
      network_(std::move(network)),
      slots_(static_cast<size_t>(slots)) {}

int ContinuousFlowEngine::free_slots() const {
  return static_cast<int>(
      std::ranges::count_if(slots_, [](const auto& slot) { return !slot.has_value(); }));
}

int ContinuousFlowEngine::Admit(const TransitionSpec& spec) {
  ValidateSpec(spec, info_);
  const auto free =
      std::ranges::find_if(slots_, [](const auto& slot) { return !slot.has_value(); });
  if (free == slots_.end()) {
    throw Error(ErrorCode::kResourceExhausted, "",
                "all " + std::to_string(slots_.size()) + " slots are taken");
  }
  Slot slot;
  slot.poses = SampleTransition(*parts_, *network_, ToWindowRequest(spec),
                                {.seed = spec.seed,
                                 .candidate = spec.candidate,
                                 .first_frame = spec.first_frame,
                                 .temperature = spec.temperature});
  LimitHinges(info_.skeleton, slot.poses);
  if (!spec.target && !(spec.controls.root_path.cols() > 0 && spec.controls.path_heights))
    ReturnToFloor(info_.skeleton, slot.poses);
  // Where a path says when to be where, time is not the beats' to bend.
  if (!spec.beats.empty() && spec.controls.root_path.cols() == 0)
    slot.poses = TimeToBeats(spec.history, slot.poses, spec.beats, Keyed(spec));
  Motion motion{.fps = info_.fps, .frames = {spec.history.back()}};
  motion.frames.insert(motion.frames.end(), slot.poses.begin(), slot.poses.end());
  slot.contacts = DetectContacts(info_.skeleton, motion);
  free->emplace(std::move(slot));
  return static_cast<int>(free - slots_.begin());
}

void ContinuousFlowEngine::Step(std::span<const StepInput> in, std::span<StepOutput> out) {
  ValidateSteps(in, out.size(), slots(), info_, [this](int number) -> std::optional<SlotProgress> {
    const auto& slot = slots_[static_cast<size_t>(number)];
    if (!slot) return std::nullopt;
    return SlotProgress{slot->next, static_cast<int>(slot->poses.size()), false};
  });
  for (size_t i = 0; i < in.size(); ++i) {
    Slot& slot = *slots_[static_cast<size_t>(in[i].slot)];
    const auto frame = static_cast<size_t>(slot.next++);
    out[i] = {.pose = slot.poses[frame], .contacts = slot.contacts[frame + 1], .log_likelihood = 0};
  }
}

}  // namespace choreo
