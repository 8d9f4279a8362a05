#include "model/plan/plan_stage.h"

#include "model/plan/beat_timing.h"
#include "model/plan/floor_return.h"
#include "model/plan/hinge_limit.h"

namespace choreo {

const std::vector<std::unique_ptr<const PlanStage>>& PlanStages() {
  static const auto stages = [] {
    std::vector<std::unique_ptr<const PlanStage>> all;
    all.push_back(std::make_unique<HingeLimit>());
    all.push_back(std::make_unique<FloorReturn>());
    all.push_back(std::make_unique<BeatTiming>());
    return all;
  }();
  return stages;
}

void FinishPlan(const PlanContext& context, std::vector<Pose>* plan) {
  for (const auto& stage : PlanStages()) stage->Apply(context, plan);
}

}  // namespace choreo
