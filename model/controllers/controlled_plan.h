#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/container/modulelist.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/normalization.h>
#include <torch/types.h>

#include "model/controllers/controlled_frames.h"
#include "model/controllers/controllers_config.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// In what units the network sees frames.
struct ControlledScale {
  static constexpr double kStep = 0.02;      ///< metres a frame that count as one
  static constexpr double kHeight = 0.2;     ///< metres of height that count as one
  static constexpr int64_t kEmbedding = 32;  ///< numbers for each count of frames

  torch::Tensor joint_mean, joint_std;  ///< [joints - 1, 3]
  torch::Tensor factor_std;             ///< [5]
  torch::Tensor shares;                 ///< [5, joints], as FactorsOf takes them

  torch::Tensor Unit(const torch::Tensor& joints) const;  ///< [..., joints - 1, 3], flattened
};

/// The plan that the network of paper C walks around: a transformer that sees history, target, path
/// and factors of all frames at once (docs/decisions.md, 36).
class ControlledPlan {
 public:
  /// Its layers become `owner`'s, under the names that checkpoints have: plan_embed, plan_blocks,
  /// plan_norm, plan_head. `scale` is its owner's, whose tensors are filled later.
  ControlledPlan(const ControllersConfig& config, const Skeleton& skeleton,
                 const ControlledScale& scale, torch::nn::Module* owner);

  struct Result {
    torch::Tensor
        residual;          ///< [batch, N, 3 (joints - 1) + 2 + 3] pose, turn, root; smooth in time
    torch::Tensor hidden;  ///< [batch, N, plan_width]
  };
  /// `reference` [batch, N, joints - 1, 3] and `ahead` [batch, N, 2]: what it adds to.
  Result Make(const ControlledTransition& transition, const torch::Tensor& reference,
              const torch::Tensor& ahead);

 private:
  torch::Tensor Tokens(const ControlledTransition& transition, const torch::Tensor& reference,
                       const torch::Tensor& ahead) const;

  ControlledScale scale_;
  double pelvis_height_;
  bool velocity_factors_;
  double blur_;
  torch::nn::Linear embed_{nullptr}, head_{nullptr};
  torch::nn::LayerNorm norm_{nullptr};
  torch::nn::ModuleList blocks_{nullptr};
};

}  // namespace choreo
