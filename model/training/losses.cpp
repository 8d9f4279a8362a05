#include "model/training/losses.h"

#include <torch/torch.h>

namespace choreo {

using torch::Tensor;

namespace {

// Standard deviation of the dequantisation noise, in units of each feature's own spread.
constexpr double kDequantisation = 0.05;

// [batch, N, joints, 3]
Tensor GlobalPositions(const TorchKinematics& kinematics, const TrajectoryTensors& poses) {
  const int64_t batch = poses.position.size(0), frames = poses.position.size(1);
  const Tensor flat =
      kinematics.Positions(poses.position.flatten(0, 1), poses.rotation.flatten(0, 1));
  return flat.view({batch, frames, flat.size(1), 3});
}

// Euclidean length of the last dimension, with a gradient at zero.
Tensor Length(const Tensor& v) { return (v.square().sum(-1) + 1e-10).sqrt(); }

}  // namespace

Tensor Dequantise(FlowModel& model, const Tensor& features) {
  const Tensor spread = model->named_buffers()["feature_std"];
  return features + kDequantisation * spread * torch::randn_like(features);
}

LossTerms LikelihoodLoss(FlowModel& model, const MotionBatch& batch,
                         const Tensor& static_condition) {
  const Tensor features = Dequantise(model, batch.features);
  return {{"nll_nats_per_dim", 1.0,
           -model->LogLikelihood(features, batch.audio, batch.has_audio, static_condition).mean() /
               model->feature_width()}};
}

LossTerms RolloutLoss(FlowModel& model, const TorchKinematics& kinematics, const MotionBatch& batch,
                      const Tensor& static_condition, double temperature) {
  const int64_t history = batch.transition.history_position.size(1);
  const int64_t frames = batch.transition.frames;
  const Tensor& truth = batch.features;
  const Tensor noise =
      temperature * torch::randn({truth.size(0), frames, truth.size(2)}, truth.options());
  const Tensor sampled = model->Rollout(truth.narrow(1, 0, history), batch.audio, batch.has_audio,
                                        static_condition, noise);
  const TrajectoryTensors poses = model->Decode(sampled);
  // Windows without a whole key have nothing to arrive at.
  const Tensor whole = batch.transition.target_mask.amin(1);
  const Tensor distance = JointDistance(kinematics, LastFrame(poses), LastFrame(batch.truth));
  const Tensor key = kDecimetresPerMetre * (distance * whole).sum() / whole.sum().clamp_min(1);
  const int64_t contacts = sampled.size(2) - 4;
  const Tensor feet =
      (sampled.narrow(2, contacts, 4) - truth.narrow(1, history, frames).narrow(2, contacts, 4))
          .abs()
          .mean();
  const Tensor way = kDecimetresPerMetre * JointDistance(kinematics, poses, batch.truth).mean();
  return {{"key_pose_dm", 0.5, key}, {"rollout_dm", 0.5, way}, {"contact_l1", 0.1, feet}};
}

TrajectoryTensors LastFrame(const TrajectoryTensors& poses) {
  return {poses.position.narrow(1, poses.position.size(1) - 1, 1),
          poses.rotation.narrow(1, poses.rotation.size(1) - 1, 1)};
}

Tensor JointDistance(const TorchKinematics& kinematics, const TrajectoryTensors& a,
                     const TrajectoryTensors& b) {
  return Length(GlobalPositions(kinematics, a) - GlobalPositions(kinematics, b)).mean({1, 2});
}

}  // namespace choreo
