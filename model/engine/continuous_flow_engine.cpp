#include "model/engine/continuous_flow_engine.h"

#include <utility>

namespace choreo {

ContinuousFlowEngine::ContinuousFlowEngine(ModelInfo info, std::string device, int slots,
                                           std::shared_ptr<const FlowModelParts> parts,
                                           std::shared_ptr<const FlowNetwork> network)
    : SlotEngine(std::move(info), std::move(device), slots),
      parts_(std::move(parts)),
      network_(std::move(network)) {}

SampledTransition ContinuousFlowEngine::Begin(const TransitionSpec& spec, int /*slot*/) {
  return {.sampling = PlanSampling(model(), *parts_, *network_, spec), .plan = {}};
}

bool ContinuousFlowEngine::Continue(SampledTransition& transition) {
  if (transition.sampling->Continue()) return true;
  transition.plan = transition.sampling->TakePlan();
  transition.sampling.reset();
  return false;
}

void ContinuousFlowEngine::StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) {
  for (size_t i = 0; i < in.size(); ++i) {
    SampledTransition& transition = At(in[i]);
    const auto frame = static_cast<size_t>(transition.next++);
    out[i] = {.pose = transition.plan.poses[frame],
              .contacts = transition.plan.contacts[frame],
              .plan = frame == 0 ? std::span<const Pose>(transition.plan.poses)
                                 : std::span<const Pose>()};
  }
}

}  // namespace choreo
