#pragma once

#include <torch/types.h>

#include "model/flow/network/torch_kinematics.h"
#include "model/papers/networks/frame_flow_model.h"
#include "model/papers/training/motion_batch.h"
#include "model/training/trainer/loss_terms.h"

/// Training losses of paper F's flow and the baseline.
namespace choreo {

/// Adds noise of `share` times the features' spread. Without it, binary contacts, derived
/// velocities and joints that never move would make the density unbounded.
torch::Tensor Dequantise(FlowModel& model, const torch::Tensor& features, double share);

/// L_flows of one batch (Eq. 6), nats per frame, mean over frames, for features dequantised by
/// `noise`.
LossTerms LikelihoodLoss(FlowModel& model, const MotionBatch& batch,
                         const torch::Tensor& static_condition, double noise);

/// Weights of the terms for a sampled roll-out (Eq. 8). A term with weight 0 is not computed.
struct RolloutWeights {
  double key = 0.5, feet = 0.1;
  double way = 0;  ///< for the distance from real frames; not in the paper
};

/// L_key pose and L_feet of one sampled roll-out (Section 3.2.3) at `temperature`: |FK(x'_N) -
/// FK(key)|, mean over joints, decimetres; |c' - c|, mean over feet and frames. Also, not in the
/// paper: the distance of all frames from the real ones, which keeps roll-outs from drifting.
LossTerms RolloutLoss(FlowModel& model, const TorchKinematics& kinematics, const MotionBatch& batch,
                      const torch::Tensor& static_condition, double temperature,
                      const RolloutWeights& weights);

/// The last frame alone.
TrajectoryTensors LastFrame(const TrajectoryTensors& poses);

/// L2P of paper F's Table 2, [batch]: the distance of global joint positions, mean over joints and
/// frames, metres.
torch::Tensor JointDistance(const TorchKinematics& kinematics, const TrajectoryTensors& a,
                            const TrajectoryTensors& b);

}  // namespace choreo
