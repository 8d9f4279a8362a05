#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/core/files/safetensors.h"
#include "model/engine/packed/kernels.h"
#include "model/engine/packed/matrix.h"
#include "model/flow/window/flow_model.h"

namespace choreo {

/// The continuous flow's network (model/flow/network/continuous_flow.h) on the calling CPU thread,
/// one window at a time. Weights are read-only and shared by threads; each thread has a workspace
/// that keeps its memory.
class PackedFlowNetwork : public FlowNetwork {
 public:
  /// Throws Error(kInvalidArgument) naming a tensor that is missing or does not fit the
  /// configuration. `products`: for the transformer's blocks; `kernels`, or less exact kernels with
  /// the same panel. Layers between poses and tokens use `kernels`.
  PackedFlowNetwork(const Safetensors& content, const ContinuousFlowConfig& config,
                    const Skeleton& skeleton, const PackedKernels& kernels,
                    const PackedKernels& products);

  Eigen::MatrixXf Condition(const Eigen::VectorXf& whole,
                            std::span<const float> times) const override;
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                           const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                           const Eigen::MatrixXf& frames,
                           const Eigen::VectorXf& condition) const override;

 private:
  struct Block {
    PackedLinear qkv, out, up, down;
    PackedLinear modulation;  ///< [condition] -> shift, scale and weight of both halves
    RowMajorMatrix bias;      ///< [heads, 2 tokens + panel], by a token's offset
  };
  struct Workspace;

  /// Tokens from `first` to before `end`.
  struct Range {
    long first, end;
  };
  /// Computes attention over time of the tokens `read`, from `qkv` of all to `mixed`.
  void Attend(const Block& block, Range read, Workspace* work) const;
  /// Computes one block: x += attention, x += perceptron, each weighted by `modulation`. Computes
  /// only the tokens `read`, the last ones, which attend to all tokens.
  void Transform(const Block& block, const float* modulation, Range read, Workspace* work) const;
  /// out = normalised x times (1 + scale) + shift, row by row; both [width].
  void Normalise(const RowBuffer& x, const float* shift, const float* scale, Range rows,
                 RowBuffer* out) const;

  const PackedKernels& kernels_;
  long width_, heads_, most_tokens_;
  Eigen::VectorXf spread_, velocity_;
  PackedLinear embed_, inject_, condition_in_, condition_out_, head_, head_modulation_;
  std::vector<Block> blocks_;
};

}  // namespace choreo
