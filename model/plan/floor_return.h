#pragma once

#include "model/plan/plan_stage.h"

namespace choreo {

/// Whoever dances for seconds touches the floor: by the last pose of a plan without key or path
/// heights the root is as much lower, or higher, as the lowest foot of all poses was above the
/// floor, or below it. The first poses stay.
class FloorReturn final : public PlanStage {
 public:
  void Apply(const PlanContext& context, std::vector<Pose>* plan) const override;
};

}  // namespace choreo
