#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/core/safetensors.h"
#include "model/engine/packed/kernels.h"
#include "model/engine/packed/matrix.h"
#include "model/flow/flow_sampler.h"

namespace choreo {

/// The continuous flow's network (model/flow/continuous_flow.h) on the CPU that calls it, on one
/// thread, one window at a time. Weights are read only: threads share it, each with a workspace of
/// its own that keeps its memory.
class PackedFlowNetwork : public FlowNetwork {
 public:
  /// Throws Error(kInvalidArgument) naming a tensor that is missing or does not fit the
  /// configuration. `products`: of the transformer's blocks, `kernels` or less exact ones of the
  /// same panel; what leads from poses to tokens and back is `kernels`'.
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
    RowMajorMatrix bias;      ///< [heads, 2 tokens + panel], of a token by how far ahead it is
  };
  struct Workspace;

  /// Attention over time, from `qkv` to `mixed`.
  void Attend(const Block& block, long tokens, Workspace* work) const;
  /// One block: x += attention, x += perceptron, each weighed by `modulation`, the block's own.
  void Transform(const Block& block, const float* modulation, long tokens, Workspace* work) const;
  /// out = normalised x times (1 + scale) + shift, row by row; both [width].
  void Normalise(const RowBuffer& x, const float* shift, const float* scale, long tokens,
                 RowBuffer* out) const;

  const PackedKernels& kernels_;
  long width_, heads_, most_tokens_;
  Eigen::VectorXf spread_, velocity_;
  PackedLinear embed_, inject_, condition_in_, condition_out_, head_, head_modulation_;
  std::vector<Block> blocks_;
};

}  // namespace choreo
