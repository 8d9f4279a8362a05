#pragma once

#include <torch/types.h>

#include "model/engine/transition_planner.h"
#include "model/flow/flow_model.h"

namespace choreo {

/// FlowModel::Begin for one transition at a time, so that a plan depends on nothing else.
class TorchPlanner : public TransitionPlanner {
 public:
  /// `model` is in eval mode, on `device`.
  TorchPlanner(FlowModel model, torch::Device device);

 private:
  TransitionPlan PlanTurning(const TransitionSpec& spec,
                             const Eigen::Vector3d& turn) const override;

  FlowModel model_;
  torch::Device device_;
};

}  // namespace choreo
