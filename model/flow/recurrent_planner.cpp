#include "model/flow/recurrent_planner.h"

#include <torch/torch.h>

#include <algorithm>

#include "model/flow/torch_kinematics.h"

namespace choreo {

using torch::Tensor;

namespace {

constexpr double kTargetNoise = 0.5;                  // standard deviation, Section 3.4
constexpr double kNoNoiseBelow = 5, kFullNoise = 30;  // frames left
constexpr double kStepScale = 0.125;  // an output of one is a step of an eighth of a spread

// lambda_target of Section 3.4.
double TargetNoise(double frames_left) {
  return kTargetNoise *
         std::clamp((frames_left - kNoNoiseBelow) / (kFullNoise - kNoNoiseBelow), 0.0, 1.0);
}

Tensor Encode(torch::nn::Linear& in, torch::nn::Linear& out, const Tensor& x) {
  return torch::silu(out(torch::silu(in(x))));
}

}  // namespace

RecurrentPlanner::RecurrentPlanner(int joints, const PlannerConfig& config)
    : PlannerImpl(joints), width_(config.width) {
  const int64_t pose = 3 + 6 * joints, mask = joints + 1, encoded = width_ / 2;
  const auto linear = [this](const char* name, int64_t in, int64_t out) {
    return register_module(name, torch::nn::Linear(in, out));
  };
  state_in_ = linear("state_in", pose, width_);
  state_out_ = linear("state_out", width_, encoded);
  offset_in_ = linear("offset_in", pose, width_);
  offset_out_ = linear("offset_out", width_, encoded);
  target_in_ = linear("target_in", pose + mask, width_);
  target_out_ = linear("target_out", width_, encoded);
  cell_ = register_module("cell", torch::nn::LSTMCell(3 * encoded, width_));
  decode_in_ = linear("decode_in", width_, width_);
  decode_ = linear("decode", width_, encoded);
  decode_out_ = linear("decode_out", encoded, pose);
  torch::nn::init::zeros_(decode_out_->weight);
  torch::nn::init::zeros_(decode_out_->bias);
}

PlannerImpl::Plan RecurrentPlanner::forward(const TransitionTensors& transition) {
  const int64_t batch = transition.target_position.size(0), frames = transition.frames;
  const int64_t history = transition.history_position.size(1), encoded = width_ / 2;
  const auto options = transition.target_position.options();

  // What the key does not name is neither seen nor missing.
  const Tensor joint_mask = transition.target_mask.narrow(1, 0, joints_);
  const Tensor mask = torch::cat({transition.target_mask.narrow(1, joints_, 1).expand({batch, 3}),
                                  joint_mask.unsqueeze(-1).expand({batch, joints_, 6}).flatten(1)},
                                 1);
  const Tensor goal = PoseFeatures({transition.target_position, transition.target_rotation}) * mask;
  const Tensor target =
      Encode(target_in_, target_out_, torch::cat({goal, transition.target_mask}, 1));
  const Tensor present = transition.target_mask.amax(1, true);
  const Tensor noise = is_training() ? torch::randn({batch, 2 * encoded}, options)
                                     : torch::zeros({batch, 2 * encoded}, options);

  Tensor h = torch::zeros({batch, width_}, options), c = torch::zeros({batch, width_}, options);
  Tensor position = transition.history_position.select(1, 0);
  Tensor rotation = transition.history_rotation.select(1, 0);
  Tensor before = PoseFeatures({position, rotation});
  std::vector<Tensor> positions, rotations, hidden;
  for (int64_t s = 0; s < history + frames - 1; ++s) {
    if (s < history) {
      position = transition.history_position.select(1, s);
      rotation = transition.history_rotation.select(1, s);
    }
    const Tensor pose = PoseFeatures({position, rotation});
    // Where the root stands is told by what is missing to the key alone: the state has its step.
    const Tensor state = torch::cat(
        {(pose - before).narrow(1, 0, 3) / kStepScale, pose.narrow(1, 3, 6 * joints_)}, 1);
    before = pose;
    const double left = static_cast<double>(history + frames - 1 - s);
    const Tensor time = TimeEmbedding(torch::full({1}, left, options), encoded) * present;
    const Tensor seen =
        torch::cat({Encode(offset_in_, offset_out_, goal - pose * mask) + time, target + time}, 1) +
        TargetNoise(left) * noise;
    std::tie(h, c) = cell_(torch::cat({Encode(state_in_, state_out_, state) + time, seen}, 1),
                           std::make_tuple(h, c));
    if (s + 1 < history) continue;

    const Tensor step =
        decode_out_(torch::silu(decode_(torch::silu(decode_in_(h))))) * kStepScale * pose_std_;
    position = position + step.narrow(1, 0, 3);
    rotation = MatrixFromSixDBatch(SixDBatch(rotation) +
                                   step.narrow(1, 3, 6 * joints_).view({batch, joints_, 6}));
    positions.push_back(position);
    rotations.push_back(rotation);
    hidden.push_back(h);
  }
  return {{torch::stack(positions, 1), torch::stack(rotations, 1)}, torch::stack(hidden, 1)};
}

}  // namespace choreo
