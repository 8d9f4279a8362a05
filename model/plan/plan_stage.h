#pragma once

#include <memory>
#include <span>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// What is known of a plan: the poses that a model proposes for a whole transition, in the
/// transition's canonical frame.
struct PlanContext {
  const Skeleton& skeleton;
  std::span<const Pose> history;       ///< before the first frame, oldest first, at least one
  std::span<const double> beats = {};  ///< frames from the first, ascending
  bool keyed = false;                  ///< it ends on a key
  bool has_path = false, has_heights = false;  ///< the root's place, and its height, were asked for
};

/// One thing that is done to a plan, between the model and arrival: what no network can know, or
/// what a rule does better. Pure; thread-safe.
class PlanStage {
 public:
  virtual ~PlanStage() = default;
  virtual void Apply(const PlanContext& context, std::vector<Pose>* plan) const = 0;
};

/// All of them, in their order: hinges bend one way, who has no key comes back to the floor, steps
/// land on beats. Add a stage here.
const std::vector<std::unique_ptr<const PlanStage>>& PlanStages();

/// Applies each.
void FinishPlan(const PlanContext& context, std::vector<Pose>* plan);

}  // namespace choreo
