#pragma once

#include "model/flow/network/torch_kinematics.h"
#include "model/training/windows/window_batch.h"

namespace choreo {

/// Computes the joint positions of windows and their derivatives with respect to the flow's
/// coordinates. Immutable, hence safe to share between threads.
class WindowBody {
 public:
  WindowBody(const Skeleton& skeleton, torch::Device device);

  /// Joint positions [batch, w, 3 * joints], metres, for coordinates x [batch, w, dimensions]
  /// relative to the batch's means. Without gradient.
  torch::Tensor Place(const WindowBatch& batch, const torch::Tensor& x) const;
  /// The displacement [batch, w, joints, 3], metres, of the batch's real joints for small changes
  /// [batch, w, dimensions] of their coordinates. Differentiable, linear.
  torch::Tensor Move(const WindowBatch& batch, const torch::Tensor& dx) const;
  /// Skeleton::feet.
  const torch::Tensor& feet() const { return feet_; }

 private:
  TorchKinematics kinematics_;
  torch::Tensor carriers_;  // [joints, joints]: 1 if the column's joint is the row's or an ancestor
  torch::Tensor parents_, feet_;
};

}  // namespace choreo
