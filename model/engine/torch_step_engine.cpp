#include "model/engine/torch_step_engine.h"

#include <torch/torch.h>

#include <algorithm>
#include <utility>

#include "model/core/error.h"
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

}  // namespace

TorchStepEngine::TorchStepEngine(std::shared_ptr<TorchWeights> weights, ModelInfo info,
                                 std::string device, int slots, int tile_rows)
    : weights_(std::move(weights)),
      info_(std::move(info)),
      device_(std::move(device)),
      slots_(static_cast<size_t>(slots), Slot(info_)),
      tile_(weights_, tile_rows),
      states_(torch::zeros({slots, weights_->model->StateWidth()}, weights_->device)) {}

int TorchStepEngine::free_slots() const {
  return static_cast<int>(std::ranges::count(slots_, false, &Slot::taken));
}

int TorchStepEngine::Admit(const TransitionSpec& spec) {
  ValidateSpec(spec, info_);
  const auto free = std::ranges::find(slots_, false, &Slot::taken);
  if (free == slots_.end()) {
    throw Error(ErrorCode::kResourceExhausted, "",
                "all " + std::to_string(slots_.size()) + " slots are taken");
  }
  const c10::InferenceMode inference;
  const int index = static_cast<int>(free - slots_.begin());
  free->window.Begin(spec, Plan(spec, &*free));
  states_[index].zero_();
  free->taken = true;
  return index;
}

// Plans the transition and hoists its static condition.
std::vector<Pose> TorchStepEngine::Plan(const TransitionSpec& spec, Slot* slot) const {
  const int joints = info_.skeleton.joints();
  // Where no key is asked for, the last pose stands in: the mask hides it.
  const Pose& goal = spec.target ? spec.target->pose : spec.history.back();
  Tensor mask = torch::zeros({1, joints + 1});
  if (spec.target) {
    const PoseMask& asked = spec.target->mask;
    float* out = mask.data_ptr<float>();
    for (int joint = 0; joint < joints; ++joint) {
      out[joint] = asked.joints.empty() || asked.joints[static_cast<size_t>(joint)] ? 1.0F : 0.0F;
    }
    out[joints] = asked.root_position ? 1.0F : 0.0F;
  }
  const auto batched = [&](const Tensor& one) { return one.unsqueeze(0).to(weights_->device); };
  FlowModel model = weights_->model;
  const TransitionContext context =
      model->Begin({.frames = spec.frames,
                    .history_position = batched(Positions(spec.history)),
                    .history_rotation = batched(Rotations(spec.history)),
                    .target_position = Positions({&goal, 1}).to(weights_->device),
                    .target_rotation = Rotations({&goal, 1}).to(weights_->device),
                    .target_mask = mask.to(weights_->device)});
  slot->static_condition = context.static_condition[0].cpu().contiguous();
  std::vector<Pose> plan;
  if (!context.reference.position.defined()) return plan;

  const Tensor position = context.reference.position[0].cpu().contiguous();
  const Tensor rotation = context.reference.rotation[0].cpu().contiguous();
  const Pose* before = &spec.history.back();
  plan.resize(static_cast<size_t>(spec.frames));
  for (int t = 0; t < spec.frames; ++t) {
    Pose& pose = plan[static_cast<size_t>(t)];
    pose.root_position =
        Eigen::Map<const Eigen::Vector3f>(position[t].data_ptr<float>()).cast<double>();
    pose.rotations.resize(3, joints);
    const float* matrices = rotation[t].data_ptr<float>();
    for (int joint = 0; joint < joints; ++joint, matrices += 9) {
      const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> matrix(matrices);
      pose.rotations.col(joint) =
          NearestBranch(LogMap(matrix.cast<double>()), before->rotations.col(joint));
    }
    before = &pose;
  }
  return plan;
}

void TorchStepEngine::StepTile(std::span<const StepInput> in, std::span<StepOutput> out) {
  const auto count = static_cast<int>(in.size());
  const auto width = static_cast<size_t>(weights_->model->feature_width());
  Tensor indices = torch::zeros({tile_.rows()}, torch::kLong);
  for (int row = 0; row < count; ++row) {
    const int index = in[static_cast<size_t>(row)].slot;
    const Slot& slot = slots_[static_cast<size_t>(index)];
    std::ranges::copy(slot.window.past(), tile_.past(row));
    std::ranges::copy(slot.window.audio(), tile_.audio(row));
    *tile_.has_audio(row) = slot.window.has_audio() ? 1.0F : 0.0F;
    const Tensor& condition = slot.static_condition;
    const float* now = condition.data_ptr<float>() + slot.window.frame() * condition.stride(0);
    std::copy(now, now + condition.stride(0), tile_.condition(row));
    slot.window.FillNoise({tile_.noise(row), width});
    indices.data_ptr<int64_t>()[row] = index;
  }
  // Rows beyond `count` are padding: they hold what was there, read slot 0's state, and are
  // dropped.
  indices = indices.to(weights_->device);
  FlowState state = states_.index_select(0, indices);
  tile_.Run(&state);
  if (state.size(1) > 0) {
    states_.index_copy_(0, indices.narrow(0, 0, count), state.narrow(0, 0, count));
  }
  for (int row = 0; row < count; ++row) {
    StepOutput& output = out[static_cast<size_t>(row)];
    slots_[static_cast<size_t>(in[static_cast<size_t>(row)].slot)].window.Finish(
        {tile_.features(row), width}, &output);
    output.log_likelihood = tile_.log_likelihood(row);
  }
}

void TorchStepEngine::Step(std::span<const StepInput> in, std::span<StepOutput> out) {
  if (in.size() != out.size()) {
    throw InvalidArgument("out", std::to_string(out.size()) + " outputs for " +
                                     std::to_string(in.size()) + " inputs");
  }
  for (const StepInput& input : in) {  // all of them, before anything moves
    if (input.slot < 0 || input.slot >= slots() || !slots_[static_cast<size_t>(input.slot)].taken) {
      throw InvalidArgument("slot", std::to_string(input.slot) + " holds no transition");
    }
    slots_[static_cast<size_t>(input.slot)].window.Check(input);
  }
  const c10::InferenceMode inference;
  for (const StepInput& input : in) slots_[static_cast<size_t>(input.slot)].window.Advance(input);
  const auto rows = static_cast<size_t>(tile_.rows());
  for (size_t first = 0; first < in.size(); first += rows) {
    const size_t count = std::min(rows, in.size() - first);
    StepTile(in.subspan(first, count), out.subspan(first, count));
  }
}

}  // namespace choreo
