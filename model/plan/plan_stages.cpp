#include "model/plan/plan_stages.h"

namespace choreo {

void FinishPlan(const PlanContext& context, std::vector<Pose>* plan) {
  for (const auto stage : {TimeToBeats, LimitHinges, ReturnToFloor}) stage(context, plan);
}

}  // namespace choreo
