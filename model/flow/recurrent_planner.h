#pragma once

#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/rnn.h>

#include "model/flow/planner.h"

namespace choreo {

/// The baseline of Harvey et al. 2020, "Robust Motion In-Betweening": a recurrent network that goes
/// frame by frame from the last pose, told at each where the key is, what is missing to it, and how
/// many frames are left (Section 3.3); while training, noise hides the key as long as it is far
/// away (Section 3.4). Their adversarial losses and contact head are left out; the losses are those
/// of our own planner, so that the two differ in the network alone.
class RecurrentPlanner : public PlannerImpl {
 public:
  RecurrentPlanner(int joints, const PlannerConfig& config);
  Plan forward(const TransitionTensors& transition) override;

 private:
  int width_;
  torch::nn::Linear state_in_{nullptr}, state_out_{nullptr}, offset_in_{nullptr},
      offset_out_{nullptr}, target_in_{nullptr}, target_out_{nullptr};
  torch::nn::LSTMCell cell_{nullptr};
  torch::nn::Linear decode_in_{nullptr}, decode_{nullptr}, decode_out_{nullptr};
};

}  // namespace choreo
