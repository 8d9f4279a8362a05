#pragma once

#include <torch/types.h>

#include "model/motion/skeleton.h"

/// The motion mathematics of model/motion, batched and differentiable. "..." is any leading shape.
/// Float32 or float64.
namespace choreo {

/// [..., 3] axis-angle → [..., 3, 3]
torch::Tensor ExpMapBatch(const torch::Tensor& w);
/// [..., 3, 3] → [..., 3], angle in [0, pi]. Its gradient is not defined at 0 and pi: use it on
/// data, not inside a loss.
torch::Tensor LogMapBatch(const torch::Tensor& r);

/// Forward kinematics of one skeleton, level by level of its tree.
class TorchKinematics {
 public:
  explicit TorchKinematics(const Skeleton& skeleton);
  /// root [M, 3] metres, local rotations [M, joints, 3, 3] → joint positions [M, joints, 3].
  torch::Tensor Positions(const torch::Tensor& root, const torch::Tensor& rotations) const;

 private:
  struct Level {
    std::vector<int64_t> joints;   ///< in tree order
    std::vector<int64_t> parents;  ///< their indices in the level above
  };
  std::vector<Level> levels_;
  std::vector<int64_t> order_;  ///< joint → its place in the concatenated levels
  torch::Tensor offsets_;       ///< [joints, 3]
};

}  // namespace choreo
