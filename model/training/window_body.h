#pragma once

#include "model/flow/torch_kinematics.h"
#include "model/training/window_batch.h"

namespace choreo {

/// Positions of windows' joints, and their derivatives by the flow's coordinates. Immutable, hence
/// safe to share between threads.
class WindowBody {
 public:
  WindowBody(const Skeleton& skeleton, torch::Device device);

  /// Joint positions [batch, w, 3 joints], metres, for coordinates x [batch, w, dimensions]
  /// relative to the batch's means. No gradient.
  torch::Tensor Place(const WindowBatch& batch, const torch::Tensor& x) const;
  /// Displacement of the batch's real joints for small changes of their coordinates: [batch, w,
  /// dimensions] → [batch, w, joints, 3] metres. Differentiable, linear.
  torch::Tensor Move(const WindowBatch& batch, const torch::Tensor& dx) const;
  /// Skeleton::feet.
  const torch::Tensor& feet() const { return feet_; }

 private:
  TorchKinematics kinematics_;
  torch::Tensor carriers_;  // [joints, joints]: 1 if the column's joint is the row's or carries it
  torch::Tensor parents_, feet_;
};

}  // namespace choreo
