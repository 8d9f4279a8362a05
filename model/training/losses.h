#pragma once

#include <torch/types.h>

#include "model/flow/flow_model.h"
#include "model/flow/torch_kinematics.h"
#include "model/training/clip_store.h"

/// Training losses. Units and reductions are part of the definition: metres summed beside nats
/// would vanish.
namespace choreo {

/// Weights of Eq. 8, for the terms as defined below.
struct FlowLossWeights {
  double likelihood = 1.0, key_pose = 0.5, contacts = 0.1;
};

struct FlowLosses {
  torch::Tensor likelihood;  ///< -log p(x), nats a dimension, mean over frames
  torch::Tensor
      key_pose;  ///< |FK(x'_N) - FK(key)| of a sampled roll-out, mean over joints, decimetres
  torch::Tensor contacts;  ///< |c' - c| of the roll-out, mean over feet and frames
};

/// Features plus noise of a twentieth of their spread, so that binary contacts, derived velocities
/// and joints that never move can't make the density unbounded.
torch::Tensor Dequantise(FlowModel& model, const torch::Tensor& features);

/// L_flows of one batch (Eq. 6), of dequantised features while training.
torch::Tensor LikelihoodLoss(FlowModel& model, const MotionBatch& batch,
                             const TransitionContext& context);

/// L_key pose and L_feet of one sampled roll-out (Section 3.2.3) at `temperature`.
std::pair<torch::Tensor, torch::Tensor> RolloutLosses(FlowModel& model,
                                                      const TorchKinematics& kinematics,
                                                      const MotionBatch& batch,
                                                      const TransitionContext& context,
                                                      double temperature);

/// The planner's: mean joint distance (m) + 0.1 x mean |6D difference| + mean joint distance of the
/// frame-to-frame steps (m).
torch::Tensor PlannerLoss(const TorchKinematics& kinematics, const MotionBatch& batch,
                          const TrajectoryTensors& plan);

/// L2P of paper F's Table 2: distance of global joint positions, mean over joints and frames,
/// metres. [batch]
torch::Tensor JointDistance(const TorchKinematics& kinematics, const TrajectoryTensors& a,
                            const TrajectoryTensors& b);

}  // namespace choreo
