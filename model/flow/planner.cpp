#include "model/flow/planner.h"

#include <torch/torch.h>

#include <cmath>

#include "model/flow/recurrent_planner.h"
#include "model/flow/time_block.h"
#include "model/flow/torch_kinematics.h"
#include "model/motion/way_round.h"

namespace choreo {

using torch::Tensor;
using torch::indexing::None;
using torch::indexing::Slice;

namespace {

constexpr int64_t kEmbeddingWidth = 32;  // of each of the two frame counts
constexpr double kRampFrames = 6;        // frames over which the residual grows from a fixed end
constexpr double kVelocityScale = 8;     // a step of an eighth of a feature's spread counts as one
constexpr double kBasis = 10000;         // Eq. 9
constexpr double kLeastAlong = 0.25, kAlongSoftness = 0.1;  // of BoundedSixD
constexpr double kFreeTurn = 0.625;  // of BoundedSixD's root: share of its bound that is free
constexpr double kEaseFrames = 30;   // over which WithoutWalk begins
// Frames of the residual's low-pass: a plan that changes its mind about the way round does so over
// some frames, with limbs that can follow; what is quicker than that is the flow's.
constexpr double kResidualSigma = 2;

// The way round that the dancer is known to turn, or is already turning. A key half a turn away can
// be reached both ways, and slerp's shorter one is the wrong one about as often as not: of two
// turns that end alike, `turn` [batch, 3] and its complement, the one nearer to what is expected.
Tensor WayRound(const Tensor& turn, const TransitionTensors& transition) {
  const Tensor angle = turn.square().sum(-1, true).add(1e-12).sqrt();
  const Tensor other = turn * (1 - 2 * M_PI / angle);
  const auto nearer = [&](const Tensor& expected) {
    const auto miss = [&](const Tensor& way) { return (way - expected).square().sum(-1, true); };
    return torch::where(miss(other) < miss(turn), other, turn);
  };
  if (transition.turning.defined()) return nearer(transition.turning);
  const int64_t history = transition.history_rotation.size(1);
  if (history < 3) return turn;
  const auto root = [&](int64_t frame) {
    return transition.history_rotation.select(1, frame).select(1, 0);
  };
  const Tensor rate =
      LogMapBatch(torch::matmul(root(history - 3).transpose(-1, -2), root(history - 1))) / 2;
  const double ahead = std::min(kTurnHorizon, static_cast<double>(transition.frames));
  return nearer(ahead * rate);
}

// `line` plus `turn`, both [batch, N, joints, 6]. The mean of two ways round (left or right?)
// nearly cancels a column of the line, and what is left flips by half a turn from one frame to the
// next. So a column's share along the line's own stays positive, softly; and the root, with which
// the whole body would flip, goes the line's way round: its turn is softly kept below `most`.
Tensor BoundedSixD(const Tensor& line, const Tensor& turn, double most) {
  const Tensor column = line.unflatten(-1, {2, 3}), wanted = turn.unflatten(-1, {2, 3});
  const Tensor root = wanted.narrow(2, 0, 1);
  const Tensor size = root.square().sum(-1, true).add(1e-12).sqrt();
  const double free = kFreeTurn * most, soft = most - free;
  const Tensor bounded =
      torch::where(size < free, size, free + soft * ((size - free) / soft).tanh());
  const Tensor sum =
      column + torch::cat({root * (bounded / size), wanted.narrow(2, 1, wanted.size(2) - 1)}, 2);
  const Tensor along = (column * sum).sum(-1, true);
  const Tensor kept =
      kLeastAlong + kAlongSoftness * torch::softplus((along - kLeastAlong) / kAlongSoftness);
  return (sum + (kept - along) * column).flatten(-2);
}

// Where no position is asked for, a mean walks on as it faces: it hardly turns, and dancers turn
// and come back. So the steady walk of `position` [batch, N, 3], that of its second half, is taken
// out by the share `free` [batch, 1]; what history leads to in the first frames stays.
Tensor WithoutWalk(const Tensor& position, const Tensor& free) {
  const int64_t frames = position.size(1), middle = frames / 2;
  if (frames - 1 == middle) return position;
  const Tensor walk = (position.select(1, frames - 1) - position.select(1, middle)) /
                      static_cast<double>(frames - 1 - middle);
  const Tensor floor = torch::tensor({1.0F, 0.0F, 1.0F}, position.options());
  const Tensor since = torch::arange(1, frames + 1, position.options());
  const Tensor eased = torch::where(since < kEaseFrames, since.square() / (2 * kEaseFrames),
                                    since - kEaseFrames / 2);
  return position - eased.view({1, -1, 1}) * (free * walk * floor).unsqueeze(1);
}

Tensor MirrorPositions(const Tensor& positions) {
  return positions * torch::tensor({-1.0F, 1.0F, 1.0F}, positions.options());
}

// Rotations [..., joints, 3, 3] of the other side's joints, each M R M with M the reflection.
Tensor MirrorRotations(const Tensor& rotations, const Tensor& pairs) {
  const Tensor reflection = torch::tensor({-1.0F, 1.0F, 1.0F}, rotations.options());
  return rotations.index_select(-3, pairs) * torch::outer(reflection, reflection);
}

}  // namespace

TrajectoryTensors Interpolate(const TransitionTensors& transition, bool as_turning) {
  const int64_t joints = transition.target_rotation.size(1);
  const Tensor u = torch::arange(1, transition.frames + 1, transition.target_position.options()) /
                   static_cast<double>(transition.frames);
  const Tensor from_position = transition.history_position.select(1, -1);
  const Tensor from_rotation = transition.history_rotation.select(1, -1);
  const Tensor joint_mask = transition.target_mask.narrow(1, 0, joints);
  const Tensor root_mask = transition.target_mask.narrow(1, joints, 1);
  const Tensor move = (transition.target_position - from_position) * root_mask;
  Tensor turn =
      LogMapBatch(torch::matmul(from_rotation.transpose(-1, -2), transition.target_rotation));
  if (as_turning) {
    turn = torch::cat(
        {WayRound(turn.select(1, 0), transition).unsqueeze(1), turn.narrow(1, 1, joints - 1)}, 1);
  }
  turn = turn * joint_mask.unsqueeze(-1);
  return {from_position.unsqueeze(1) + u.view({1, -1, 1}) * move.unsqueeze(1),
          torch::matmul(from_rotation.unsqueeze(1),
                        ExpMapBatch(u.view({1, -1, 1, 1}) * turn.unsqueeze(1)))};
}

Tensor TimeEmbedding(const Tensor& counts, int64_t width) {
  const Tensor pair = torch::arange(0, (width + 1) / 2, counts.options());
  const Tensor rate = torch::exp(pair * (-2.0 * std::log(kBasis) / static_cast<double>(width)));
  const Tensor phase = counts.unsqueeze(-1) * rate;
  return torch::stack({phase.sin(), phase.cos()}, -1).flatten(-2).narrow(-1, 0, width);
}

PlannerImpl::PlannerImpl(int joints) : joints_(joints) {
  pose_mean_ = register_buffer("pose_mean", torch::zeros({3 + 6 * joints}));
  pose_std_ = register_buffer("pose_std", torch::ones({3 + 6 * joints}));
}

Tensor PlannerImpl::PoseFeatures(const TrajectoryTensors& poses) const {
  const Tensor six_d = SixDBatch(poses.rotation).flatten(-2);
  return (torch::cat({poses.position, six_d}, -1) - pose_mean_) / pose_std_;
}

void PlannerImpl::SetPoseNormalisation(const Tensor& mean, const Tensor& std) {
  torch::NoGradGuard no_grad;
  pose_mean_.copy_(mean);
  pose_std_.copy_(std);
}

TransitionTensors MirrorTransition(const TransitionTensors& transition, const Tensor& pairs) {
  const int64_t joints = transition.target_rotation.size(1);
  TransitionTensors mirrored = transition;
  mirrored.history_position = MirrorPositions(transition.history_position);
  mirrored.target_position = MirrorPositions(transition.target_position);
  mirrored.history_rotation = MirrorRotations(transition.history_rotation, pairs);
  mirrored.target_rotation = MirrorRotations(transition.target_rotation, pairs);
  mirrored.target_mask =
      torch::cat({transition.target_mask.narrow(1, 0, joints).index_select(1, pairs),
                  transition.target_mask.narrow(1, joints, 1)},
                 1);
  if (transition.turning.defined()) {
    mirrored.turning =
        transition.turning * torch::tensor({1.0F, -1.0F, -1.0F}, transition.turning.options());
  }
  return mirrored;
}

PlannerImpl::Plan PlannerImpl::Balanced(const TransitionTensors& transition, const Tensor& pairs) {
  const TransitionTensors other = MirrorTransition(transition, pairs);
  const int64_t batch = transition.target_position.size(0);
  const auto both = [](const Tensor& a, const Tensor& b) {
    return a.defined() ? torch::cat({a, b}, 0) : a;
  };
  const Plan plan =
      forward({.frames = transition.frames,
               .history_position = both(transition.history_position, other.history_position),
               .history_rotation = both(transition.history_rotation, other.history_rotation),
               .target_position = both(transition.target_position, other.target_position),
               .target_rotation = both(transition.target_rotation, other.target_rotation),
               .target_mask = both(transition.target_mask, other.target_mask),
               .turning = both(transition.turning, other.turning)});
  const Tensor& position = plan.trajectory.position;
  const Tensor& rotation = plan.trajectory.rotation;
  const Tensor six_d = SixDBatch(rotation.narrow(0, 0, batch)) +
                       SixDBatch(MirrorRotations(rotation.narrow(0, batch, batch), pairs));
  const Tensor mean =
      0.5 * (position.narrow(0, 0, batch) + MirrorPositions(position.narrow(0, batch, batch)));
  const Tensor free = 1 - transition.target_mask.narrow(1, rotation.size(2), 1);
  return {{WithoutWalk(mean, free), MatrixFromSixDBatch(six_d)}, plan.hidden.narrow(0, 0, batch)};
}

namespace {

// Interpolation plus a smooth residual from a transformer over history, gap and key.
class TransformerPlanner : public PlannerImpl {
 public:
  TransformerPlanner(int joints, const PlannerConfig& config);
  Plan forward(const TransitionTensors& transition) override;

 private:
  int width_;
  double root_turn_;
  torch::nn::Linear embed_{nullptr}, head_{nullptr};
  torch::nn::LayerNorm norm_{nullptr};
  torch::nn::ModuleList blocks_;
};

TransformerPlanner::TransformerPlanner(int joints, const PlannerConfig& config)
    : PlannerImpl(joints), width_(config.width), root_turn_(config.root_turn) {
  // Token: the pose, its step, the step that leaves the history (root 3, rotations 6 a joint,
  // each), key mask (joints + root), is-history, is-key, two frame counts.
  const int64_t features = 3 * (3 + 6 * joints) + joints + 1 + 2 + 2 * kEmbeddingWidth;
  embed_ = register_module("embed", torch::nn::Linear(features, width_));
  blocks_ = register_module("blocks", torch::nn::ModuleList());
  for (int i = 0; i < config.layers; ++i)
    blocks_->push_back(TimeBlock(width_, config.heads, config.dropout));
  norm_ = register_module("norm", torch::nn::LayerNorm(torch::nn::LayerNormOptions({width_})));
  head_ = register_module("head", torch::nn::Linear(width_, 3 + 6 * joints));
  torch::nn::init::zeros_(head_->weight);
  torch::nn::init::zeros_(head_->bias);
}

PlannerImpl::Plan TransformerPlanner::forward(const TransitionTensors& transition) {
  const int64_t batch = transition.target_position.size(0), frames = transition.frames;
  const int64_t history = transition.history_position.size(1), time = history + frames;
  const auto options = transition.target_position.options();
  const TrajectoryTensors line = Interpolate(transition, /*as_turning=*/true);

  const Tensor line_six_d = SixDBatch(line.rotation).flatten(2);
  const Tensor is_history = torch::zeros({1, time, 1}, options);
  is_history.narrow(1, 0, history).fill_(1);
  const Tensor is_key = torch::zeros({1, time, 1}, options);
  is_key.narrow(1, time - 1, 1).fill_(1);
  const Tensor present = transition.target_mask.amax(1).view({batch, 1, 1});
  const Tensor since = torch::arange(-history, frames, options).view({1, time});
  const Tensor left = (frames - 1) - since;
  const Tensor poses = PoseFeatures({torch::cat({transition.history_position, line.position}, 1),
                                     torch::cat({transition.history_rotation, line.rotation}, 1)});
  // Velocities stand in the tokens: attention takes very long to find such small differences
  // itself.
  const Tensor steps_before = kVelocityScale * (poses - torch::roll(poses, 1, 1));
  steps_before.narrow(1, 0, 1).zero_();
  const Tensor leaving = steps_before.narrow(1, history - 1, 1).expand_as(poses);
  const Tensor tokens = torch::cat(
      {poses, steps_before, leaving,
       transition.target_mask.unsqueeze(1).expand({batch, time, joints_ + 1}),
       is_history.expand({batch, time, 1}), is_key * present,
       TimeEmbedding(since, kEmbeddingWidth).expand({batch, time, kEmbeddingWidth}),
       // Without a key nothing is awaited: the frames left must not matter.
       TimeEmbedding(left, kEmbeddingWidth).expand({batch, time, kEmbeddingWidth}) * present},
      -1);

  const Tensor distance = TimeDistances(time, options.device());
  Tensor x = embed_(tokens);
  for (const auto& block : *blocks_) x = block->as<TimeBlock>()->forward(x, distance);
  const Tensor hidden = norm_(x).narrow(1, history, frames);

  // The residual grows from zero behind the history and, for what the key fixes, shrinks to zero at
  // the key.
  const Tensor from_start = ((since.narrow(1, history, frames) + 1) / kRampFrames).clamp_max(1);
  const Tensor to_key = (left.narrow(1, history, frames) / kRampFrames).clamp_max(1);
  const Tensor mask = transition.target_mask.unsqueeze(1);  // [batch, 1, joints + 1]
  const Tensor ramp = from_start.unsqueeze(-1) *
                      (1 - mask + mask * to_key.unsqueeze(-1));  // [batch, N, joints + 1]
  const Tensor residual = SmoothInTime(head_(hidden), kResidualSigma) * pose_std_;
  const Tensor move = residual.narrow(2, 0, 3) * ramp.narrow(2, joints_, 1);
  const Tensor turn = residual.narrow(2, 3, 6 * joints_).view({batch, frames, joints_, 6}) *
                      ramp.narrow(2, 0, joints_).unsqueeze(-1);
  return {
      {line.position + move, MatrixFromSixDBatch(BoundedSixD(
                                 line_six_d.view({batch, frames, joints_, 6}), turn, root_turn_))},
      hidden};
}

}  // namespace

Planner MakePlanner(int joints, const PlannerConfig& config) {
  if (config.width == 0) return nullptr;
  if (config.recurrent) return std::make_shared<RecurrentPlanner>(joints, config);
  return std::make_shared<TransformerPlanner>(joints, config);
}

}  // namespace choreo
