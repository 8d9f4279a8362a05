#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/engine/packed_matrix.h"
#include "model/engine/packed_tensors.h"
#include "model/flow/flow_config.h"

namespace choreo {

/// The planner's transformer (TransformerPlanner of model/flow/planner.cpp) on packed weights: a
/// transition and its mirror image, in one batch. What it computes is a function of its arguments
/// alone, whatever thread does it. Read only; the engines of a process share it.
class PackedTransformer {
 public:
  static constexpr int kSides = 2;  ///< the transition and its mirror image

  /// What one pass works on. Kept by callers for its memory: a pass no longer than those before
  /// allocates nothing.
  struct Scratch {
    RowBuffer poses;  ///< in: [kSides * (tau + frames), pose_width()], history, then interpolation;
                      ///< metres and 6D rotations
    RowBuffer masks;  ///< in: [kSides, joints + 1], what the key asks for of joints and position
    RowBuffer hidden;    ///< out: [kSides * frames, width()]
    RowBuffer residual;  ///< out: [kSides * frames, >= pose_width()], in spreads of poses
    RowBuffer input, fixed_input, fixed, x, normal, wide, mixed, scores, keys, values;
  };

  /// Throws as PackedTensors does. `products`: for the layers' products, `kernels` or less exact
  /// ones of the same panel.
  PackedTransformer(const PackedTensors& tensors, int joints, const FlowConfig& config,
                    const PackedKernels& kernels, const PackedKernels& products);

  int width() const { return width_; }
  /// Floats of a pose: root position, then 6D rotations.
  int pose_width() const { return static_cast<int>(pose_std.size()); }

  /// Frames are in [1, the longest transition].
  void Run(int frames, Scratch* scratch) const;

  Eigen::VectorXf pose_mean, pose_std;

 private:
  struct Block {
    Eigen::VectorXf attention_gain, attention_bias, mlp_gain, mlp_bias;
    PackedLinear qkv, out, up, down;
    RowMajorMatrix distance_bias;  // [heads, distances]: key - query stands at most_ + key - query
  };

  void Embed(int frames, Scratch* s) const;
  void Attend(const Block& block, int time, int first, Scratch* s) const;
  void Normalise(const Eigen::VectorXf& gain, const Eigen::VectorXf& bias, const RowBuffer& x,
                 long from, long rows, float* out) const;

  const PackedKernels& kernels_;
  int width_, heads_, tau_, most_;  // most_: frames of history and of the longest transition
  PackedLinear embed_, embed_fixed_, head_;
  RowMajorMatrix since_, left_;  // [frames, width]: what frame counts and kinds add to a token
  Eigen::RowVectorXf is_key_;
  Eigen::VectorXf final_gain_, final_bias_, nothing_;
  std::vector<Block> blocks_;
};

}  // namespace choreo
