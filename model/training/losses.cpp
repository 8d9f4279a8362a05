#include "model/training/losses.h"

#include <torch/torch.h>

namespace choreo {

using torch::Tensor;

namespace {

constexpr const char *kPlannerPosition = "planner_position_m", *kPlannerSixD = "planner_six_d",
                     *kPlannerStep = "planner_step_m", *kLikelihood = "nll_nats_per_dim",
                     *kKeyPose = "key_pose_dm", *kWay = "rollout_dm", *kContacts = "contact_l1";

// Standard deviation of the dequantisation noise, in units of each feature's own spread.
constexpr double kDequantisation = 0.05;
constexpr double kDecimetresPerMetre = 10;

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

const std::vector<std::string>& LossTermNames() {
  static const std::vector<std::string> names = {
      kPlannerPosition, kPlannerSixD, kPlannerStep, kLikelihood, kKeyPose, kWay, kContacts};
  return names;
}

LossTerms LikelihoodLoss(FlowModel& model, const MotionBatch& batch,
                         const TransitionContext& context) {
  Tensor features = model->RelativeFeatures(batch.features, batch.truth, context);
  if (model->is_training()) features = Dequantise(model, features);
  return {{kLikelihood, 1.0,
           -model->LogLikelihood(features, batch.audio, batch.has_audio, context).mean() /
               model->feature_width()}};
}

LossTerms RolloutLoss(FlowModel& model, const TorchKinematics& kinematics, const MotionBatch& batch,
                      const TransitionContext& context, double temperature) {
  const int64_t history = batch.transition.history_position.size(1);
  const int64_t frames = batch.transition.frames;
  const Tensor truth = model->RelativeFeatures(batch.features, batch.truth, context);
  const Tensor noise =
      temperature * torch::randn({truth.size(0), frames, truth.size(2)}, truth.options());
  const Tensor sampled =
      model->Rollout(truth.narrow(1, 0, history), batch.audio, batch.has_audio, context, noise);
  const TrajectoryTensors poses = model->Decode(sampled, context);
  const auto last = [&](const TrajectoryTensors& all) {
    return TrajectoryTensors{all.position.narrow(1, frames - 1, 1),
                             all.rotation.narrow(1, frames - 1, 1)};
  };
  // Windows without a whole key have nothing to arrive at.
  const Tensor whole = batch.transition.target_mask.amin(1);
  const Tensor distance = JointDistance(kinematics, last(poses), last(batch.truth));
  const Tensor key = kDecimetresPerMetre * (distance * whole).sum() / whole.sum().clamp_min(1);
  const int64_t contacts = sampled.size(2) - 4;
  const Tensor feet =
      (sampled.narrow(2, contacts, 4) - truth.narrow(1, history, frames).narrow(2, contacts, 4))
          .abs()
          .mean();
  const Tensor way = kDecimetresPerMetre * JointDistance(kinematics, poses, batch.truth).mean();
  return {{kKeyPose, 0.5, key}, {kWay, 0.5, way}, {kContacts, 0.1, feet}};
}

LossTerms PlannerLoss(const TorchKinematics& kinematics, const MotionBatch& batch,
                      const TrajectoryTensors& plan) {
  const Tensor planned = GlobalPositions(kinematics, plan);
  const Tensor truth = GlobalPositions(kinematics, batch.truth);
  const Tensor six_d = (SixDBatch(plan.rotation) - SixDBatch(batch.truth.rotation)).abs().mean();
  const auto steps = [](const Tensor& x) {
    return x.narrow(1, 1, x.size(1) - 1) - x.narrow(1, 0, x.size(1) - 1);
  };
  return {{kPlannerPosition, 1.0, Length(planned - truth).mean()},
          {kPlannerSixD, 0.1, six_d},
          {kPlannerStep, 1.0, Length(steps(planned) - steps(truth)).mean()}};
}

Tensor JointDistance(const TorchKinematics& kinematics, const TrajectoryTensors& a,
                     const TrajectoryTensors& b) {
  return Length(GlobalPositions(kinematics, a) - GlobalPositions(kinematics, b)).mean({1, 2});
}

}  // namespace choreo
