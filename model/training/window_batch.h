#pragma once

#include <torch/types.h>

#include <optional>
#include <span>
#include <vector>

#include "model/flow/flow_sampler.h"

namespace choreo {

/// A batch of windows of equal shape as the continuous flow sees them; see FlowNetwork for what
/// the tensors are. Time stands before features, float32.
struct WindowBatch {
  int frames = 0, to_key = 0;
  torch::Tensor z = {};                     ///< [batch, w, dimensions] real motion, white
  torch::Tensor scales = {};                ///< [batch, w, dimensions] as FlowWindow has them
  std::vector<double> surprise = {};        ///< [batch], the same
  torch::Tensor keyed = {};                 ///< [batch, dimensions] in {0, 1}
  torch::Tensor staged = {};                ///< [batch] in {0, 1}: FlowWindow::staged
  torch::Tensor mean = {};                  ///< [batch, tau + w, dimensions], history in front
  torch::Tensor features = {}, whole = {};  ///< of WindowFeatures
  torch::Tensor history_joints = {};        ///< [batch, tau, 3 joints] metres
  /// The mean as poses: root positions [batch, w, 3] and local rotations [batch, w, joints, 3, 3].
  torch::Tensor base_root = {}, base_turns = {};
  /// Of the real motion: the turn in the world that a unit of each of a joint's coordinates makes
  /// [batch, w, joints, 3, 3], and the way from its parent to it [batch, w, joints, 3] in metres.
  torch::Tensor axes = {}, bones = {};
  std::vector<WindowRequest> requests = {};   ///< what each was asked for
  std::vector<std::vector<Pose>> truth = {};  ///< [batch][w] canonical frame

  /// Its tensors there, without requests and truth.
  WindowBatch To(torch::Device device) const;
};

/// [rows, columns] → [columns, rows], float32.
template <typename Matrix>
torch::Tensor Columns(const Matrix& matrix) {
  const Eigen::MatrixXf floats = matrix.template cast<float>();
  return torch::from_blob(const_cast<float*>(floats.data()), {floats.cols(), floats.rows()})
      .clone();
}

/// A batch of one window whose tensors lack the dimension [batch]. `truth` [frames]: what was
/// danced there, in the request's frame. None where it strays from any line to the key.
std::optional<WindowBatch> MakeWindow(const FlowModelParts& model, WindowRequest request,
                                      std::span<const Pose> truth);
/// Of such windows, at least one, all of one shape.
WindowBatch Stack(std::vector<WindowBatch> windows);

}  // namespace choreo
