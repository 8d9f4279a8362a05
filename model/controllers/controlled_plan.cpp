#include "model/controllers/controlled_plan.h"

#include <torch/torch.h>

#include "model/flow/planner.h"
#include "model/flow/time_block.h"
#include "model/motion/velocity_factors.h"

namespace choreo {

using torch::Tensor;

Tensor ControlledScale::Unit(const Tensor& joints) const {
  return ((joints - joint_mean) / joint_std).flatten(-2);
}

ControlledPlan::ControlledPlan(const ControllersConfig& config, const Skeleton& skeleton,
                               const ControlledScale& scale, torch::nn::Module* owner)
    : scale_(scale),
      pelvis_height_(skeleton.pelvis_height),
      velocity_factors_(config.velocity_factors),
      blur_(config.plan_blur) {
  const int64_t pose = 3 * (skeleton.joints() - 1);
  // Pose, its step, the step that leaves the history; root step, height, way to the end, turn to
  // the target; factors; is-history, is-target; two counts of frames.
  const int64_t token = 3 * pose + 3 + 1 + 3 + 2 + kBodyParts + 2 + 2 * ControlledScale::kEmbedding;
  embed_ = owner->register_module("plan_embed", torch::nn::Linear(token, config.plan_width));
  blocks_ = owner->register_module("plan_blocks", torch::nn::ModuleList());
  for (int i = 0; i < config.plan_layers; ++i)
    blocks_->push_back(TimeBlock(config.plan_width, config.plan_heads, config.plan_dropout));
  norm_ = owner->register_module(
      "plan_norm", torch::nn::LayerNorm(torch::nn::LayerNormOptions({config.plan_width})));
  head_ = owner->register_module("plan_head", torch::nn::Linear(config.plan_width, pose + 2 + 3));
  torch::nn::init::zeros_(head_->weight);
  torch::nn::init::zeros_(head_->bias);
}

Tensor ControlledPlan::Tokens(const ControlledTransition& transition, const Tensor& reference,
                              const Tensor& ahead) const {
  const FrameTensors& history = transition.history;
  const int64_t batch = reference.size(0), frames = transition.frames, tau = history.size(),
                time = tau + frames;
  const auto options = reference.options();
  const Tensor poses = scale_.Unit(torch::cat({history.joints, reference}, 1));
  const Tensor steps =
      (history.joints.narrow(1, 1, tau - 1) - history.joints.narrow(1, 0, tau - 1)).flatten(-2) /
      ControlledScale::kStep;
  const int64_t width = poses.size(2);
  const Tensor stepped = torch::cat({torch::zeros({batch, 1, width}, options), steps,
                                     torch::zeros({batch, frames, width}, options)},
                                    1);
  const Tensor leaving = steps.narrow(1, tau - 2, 1).expand_as(poses);
  const Tensor root = torch::cat({history.root, transition.path}, 1);
  const Tensor facing = torch::cat({history.facing, ahead}, 1);
  const Tensor before = torch::cat({root.narrow(1, 0, 1), root.narrow(1, 0, time - 1)}, 1);
  const Tensor has = transition.has_target.unsqueeze(1);  // [batch, 1, 1]
  const Tensor end = root.narrow(1, time - 1, 1);
  const Tensor past = FactorsOf(Steps(history), scale_.shares) / scale_.factor_std;
  const Tensor given = transition.factors / scale_.factor_std;
  const Tensor factors =
      torch::cat({past.narrow(1, 0, 1), past, given}, 1) * (velocity_factors_ ? 1.0 : 0.0);
  const Tensor is_history = torch::zeros({1, time, 1}, options);
  is_history.narrow(1, 0, tau).fill_(1);
  const Tensor is_target = torch::zeros({1, time, 1}, options);
  is_target.narrow(1, time - 1, 1).fill_(1);
  const Tensor since = torch::arange(-tau, frames, options).view({1, time});
  const Tensor left = (frames - 1) - since;
  const auto all = [&](const Tensor& x) { return x.expand({batch, time, x.size(-1)}); };
  return torch::cat(
      {poses, stepped, leaving, TurnBack(root - before, facing) / ControlledScale::kStep,
       (root.narrow(2, 1, 1) - pelvis_height_) / ControlledScale::kHeight,
       TurnBack(end - root, facing) * has,
       SubtractHeadings(HeadingOf(transition.target_turn).unsqueeze(1), facing) * has, factors,
       all(is_history), is_target * has, all(TimeEmbedding(since, ControlledScale::kEmbedding)),
       TimeEmbedding(left, ControlledScale::kEmbedding) * has},
      -1);
}

ControlledPlan::Result ControlledPlan::Make(const ControlledTransition& transition,
                                            const Tensor& reference, const Tensor& ahead) {
  Tensor x = embed_->forward(Tokens(transition, reference, ahead));
  const Tensor distance = TimeDistances(x.size(1), x.device());
  for (const auto& block : *blocks_) x = block->as<TimeBlock>()->forward(x, distance);
  const Tensor hidden = norm_->forward(x).narrow(1, transition.history.size(), transition.frames);
  // Smoothed twice (Tukey's twicing): of 5 Hz as little passes as through a Gaussian that lets 0.78
  // of 2 Hz pass, but 0.91 of 2 Hz.
  const Tensor smooth = SmoothInTime(head_->forward(hidden), blur_);
  return {2 * smooth - SmoothInTime(smooth, blur_), hidden};
}

}  // namespace choreo
