#include "model/papers/training/flow_losses.h"

namespace choreo {

using torch::Tensor;

namespace {

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

Tensor Dequantise(FlowModel& model, const Tensor& features, double share) {
  return features + share * model->DrawnSpread() * torch::randn_like(features);
}

LossTerms LikelihoodLoss(FlowModel& model, const MotionBatch& batch, const Tensor& static_condition,
                         double noise) {
  const Tensor features = Dequantise(model, batch.features, noise);
  // Eq. 6 sums over features; the curve shows their mean.
  return {{"nll_nats_per_dim", static_cast<double>(model->feature_width()),
           -model->LogLikelihood(features, batch.audio, batch.has_audio, static_condition).mean() /
               model->feature_width()}};
}

LossTerms RolloutLoss(FlowModel& model, const TorchKinematics& kinematics, const MotionBatch& batch,
                      const Tensor& static_condition, double temperature,
                      const RolloutWeights& weights) {
  const int64_t history = batch.transition.history_position.size(1);
  const int64_t frames = batch.transition.frames;
  const Tensor& truth = batch.features;
  const Tensor noise =
      temperature * torch::randn({truth.size(0), frames, truth.size(2)}, truth.options());
  const Tensor sampled = model->Rollout(truth.narrow(1, 0, history), batch.audio, batch.has_audio,
                                        static_condition, noise);
  const TrajectoryTensors poses = DecodePoses(model->skeleton(), sampled);
  LossTerms terms;
  if (weights.key > 0) {
    // Windows without a whole key do not count.
    const Tensor whole = batch.transition.target_mask.amin(1);
    const Tensor distance = JointDistance(kinematics, LastFrame(poses), LastFrame(batch.truth));
    const Tensor key = kDecimetresPerMetre * (distance * whole).sum() / whole.sum().clamp_min(1);
    terms.push_back({"key_pose_dm", weights.key, key});
  }
  if (weights.way > 0) {
    const Tensor way = kDecimetresPerMetre * JointDistance(kinematics, poses, batch.truth).mean();
    terms.push_back({"rollout_dm", weights.way, way});
  }
  const int64_t contacts = sampled.size(2) - 4;
  const Tensor feet =
      (sampled.narrow(2, contacts, 4) - truth.narrow(1, history, frames).narrow(2, contacts, 4))
          .abs()
          .mean();
  terms.push_back({"contact_l1", weights.feet, feet});
  return terms;
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
