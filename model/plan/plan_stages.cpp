#include "model/plan/plan_stages.h"

namespace choreo {

void FinishPlan(const PlanContext& context, std::vector<Pose>* plan) {
  for (const auto stage : {LimitHinges, ReturnToFloor, TimeToBeats}) stage(context, plan);
}

}  // namespace choreo
