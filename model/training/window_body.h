#pragma once

#include "model/flow/torch_kinematics.h"
#include "model/training/window_batch.h"

namespace choreo {

/// Where the joints of windows are, and how they move with the flow's coordinates. Immutable, hence
/// safe to share between threads.
class WindowBody {
 public:
  WindowBody(const Skeleton& skeleton, torch::Device device);

  /// Joint positions [batch, w, 3 joints], metres, of coordinates x [batch, w, dimensions] from the
  /// batch's means. No gradient.
  torch::Tensor Place(const WindowBatch& batch, const torch::Tensor& x) const;
  /// How far the batch's real joints go where their coordinates change by a little:
  /// [batch, w, dimensions] → [batch, w, joints, 3] metres. Differentiable, linear.
  torch::Tensor Move(const WindowBatch& batch, const torch::Tensor& dx) const;
  /// Skeleton::feet.
  const torch::Tensor& feet() const { return feet_; }

 private:
  TorchKinematics kinematics_;
  torch::Tensor
      carriers_;  // [joints, joints]: 1 where the column's joint carries the row's, or is it
  torch::Tensor parents_, feet_;
};

}  // namespace choreo
