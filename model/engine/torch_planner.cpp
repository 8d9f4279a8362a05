#include "model/engine/torch_planner.h"

#include <torch/torch.h>

#include <utility>

#include "model/core/random.h"
#include "model/engine/temperature.h"
#include "model/motion/rotation.h"

namespace choreo {

using torch::Tensor;

namespace {

Tensor Positions(std::span<const Pose> poses) {
  Tensor positions = torch::empty({static_cast<int64_t>(poses.size()), 3});
  float* out = positions.data_ptr<float>();
  for (const Pose& pose : poses) {
    Eigen::Map<Eigen::Vector3f>(std::exchange(out, out + 3)) = pose.root_position.cast<float>();
  }
  return positions;
}

Tensor Rotations(std::span<const Pose> poses) {
  const int64_t joints = poses[0].rotations.cols();
  Tensor matrices = torch::empty({static_cast<int64_t>(poses.size()), joints, 3, 3});
  float* out = matrices.data_ptr<float>();
  for (const Pose& pose : poses) {
    for (int64_t joint = 0; joint < joints; ++joint, out += 9) {
      Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>{out} =
          ExpMap(pose.rotations.col(joint)).cast<float>();
    }
  }
  return matrices;
}

// [1, joints + 1]
Tensor Mask(const TransitionSpec& spec, int joints) {
  Tensor mask = torch::zeros({1, joints + 1});
  if (!spec.target) return mask;
  const PoseMask& asked = spec.target->mask;
  float* out = mask.data_ptr<float>();
  for (int joint = 0; joint < joints; ++joint) {
    out[joint] = asked.Asks(joint) ? 1.0F : 0.0F;
  }
  out[joints] = asked.root_position ? 1.0F : 0.0F;
  return mask;
}

// Noise of the plan: [1, waves, components], of each wave its share. It lies behind the noise of
// the first frame's own features, so the two are unrelated.
Tensor VarietyOf(const TransitionSpec& spec, const FlowModel& model) {
  const Liveliness liveliness = LivelinessOf(model->skeleton(), spec);
  const int64_t waves = VarietyImpl::Waves(spec.frames);
  const int64_t components = model->variety()->components();
  const auto used = static_cast<size_t>(model->feature_width());
  std::vector<float> noise(used + static_cast<size_t>(waves * components));
  FillNormal(spec.seed, spec.candidate, spec.first_frame, noise);
  Tensor variety = torch::empty({1, waves, components});
  float* out = variety.data_ptr<float>();
  const float* in = noise.data() + used;
  for (int wave = 0; wave < waves; ++wave) {
    const WaveShare share = ShareOf(spec, liveliness, wave, static_cast<int>(components));
    for (int64_t i = 0; i < components; ++i, ++in)
      *out++ = i < share.components ? share.temperature * *in : 0.0F;
  }
  return variety;
}

std::vector<Pose> Poses(const Tensor& positions, const Tensor& rotations, const Pose* before) {
  const Tensor position = positions.cpu().contiguous(), rotation = rotations.cpu().contiguous();
  const int64_t joints = rotation.size(1);
  std::vector<Pose> poses(static_cast<size_t>(position.size(0)));
  const float* root = position.data_ptr<float>();
  const float* matrices = rotation.data_ptr<float>();
  for (Pose& pose : poses) {
    pose.root_position = Eigen::Map<const Eigen::Vector3f>(root).cast<double>();
    root += 3;
    pose.rotations.resize(3, joints);
    for (int64_t joint = 0; joint < joints; ++joint, matrices += 9) {
      const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> matrix(matrices);
      pose.rotations.col(joint) =
          NearestBranch(LogMap(matrix.cast<double>()), before->rotations.col(joint));
    }
    before = &pose;
  }
  return poses;
}

}  // namespace

TorchPlanner::TorchPlanner(FlowModel model, torch::Device device)
    : model_(std::move(model)), device_(device) {}

TransitionPlan TorchPlanner::PlanTurning(const TransitionSpec& spec,
                                         const Eigen::Vector3d& turn) const {
  const c10::InferenceMode inference;
  const auto there = [&](const Tensor& one) { return one.to(device_); };
  // Where no key is asked for, the last pose stands in: the mask hides it.
  const Pose& goal = spec.target ? spec.target->pose : spec.history.back();
  FlowModel model = model_;
  Tensor variety;
  if (model->variety() && spec.temperature > 0) variety = there(VarietyOf(spec, model));
  const TransitionContext context = model->Begin(
      {.frames = spec.frames,
       .history_position = there(Positions(spec.history).unsqueeze(0)),
       .history_rotation = there(Rotations(spec.history).unsqueeze(0)),
       .target_position = there(Positions({&goal, 1})),
       .target_rotation = there(Rotations({&goal, 1})),
       .target_mask = there(Mask(spec, model->skeleton().joints())),
       .turning = there(torch::tensor({{static_cast<float>(turn.x()), static_cast<float>(turn.y()),
                                        static_cast<float>(turn.z())}}))},
      variety);
  TransitionPlan plan;
  const Tensor condition = context.static_condition[0].cpu().contiguous();
  plan.static_condition.assign(condition.data_ptr<float>(),
                               condition.data_ptr<float>() + condition.numel());
  if (context.reference.position.defined()) {
    plan.poses =
        Poses(context.reference.position[0], context.reference.rotation[0], &spec.history.back());
  }
  return plan;
}

}  // namespace choreo
