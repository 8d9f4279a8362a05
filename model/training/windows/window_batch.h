#pragma once

#include <torch/types.h>

#include <optional>
#include <span>
#include <vector>

#include "model/flow/window/flow_model.h"

namespace choreo {

/// A batch of equally long windows for the continuous flow. FlowNetwork explains the tensors. Time
/// precedes features; float32.
struct WindowBatch {
  int frames = 0, to_key = 0;
  torch::Tensor z = {};               ///< [batch, w, dimensions] real motion, in white coordinates
  torch::Tensor scales = {};          ///< [batch, w, dimensions] as in FlowWindow
  std::vector<double> surprise = {};  ///< [batch] as in FlowWindow
  torch::Tensor keyed = {};           ///< [batch, dimensions] in {0, 1}
  torch::Tensor staged = {};          ///< [batch] in {0, 1}: FlowWindow::staged
  torch::Tensor mean = {};            ///< [batch, tau + w, dimensions], history in front
  torch::Tensor features = {}, whole = {};  ///< from WindowFeatures
  torch::Tensor history_joints = {};        ///< [batch, tau, 3 joints] metres
  /// The mean as poses: root positions [batch, w, 3] and local rotations [batch, w, joints, 3, 3].
  torch::Tensor base_root = {}, base_turns = {};
  /// For the real motion: the world rotation by one unit of each coordinate of a joint [batch, w,
  /// joints, 3, 3], and the offset from its parent [batch, w, joints, 3] in metres.
  torch::Tensor axes = {}, bones = {};
  std::vector<WindowRequest> requests = {};   ///< the request of each window
  std::vector<std::vector<Pose>> truth = {};  ///< [batch][w] canonical frame

  /// The batch with its tensors on another device, without requests and truth.
  WindowBatch To(torch::Device device) const;
};

/// Converts an Eigen matrix [rows, columns] to a tensor [columns, rows], float32.
template <typename Matrix>
torch::Tensor Columns(const Matrix& matrix) {
  const Eigen::MatrixXf floats = matrix.template cast<float>();
  return torch::from_blob(const_cast<float*>(floats.data()), {floats.cols(), floats.rows()})
      .clone();
}

/// Makes a single window, whose tensors lack the dimension [batch]. `truth` [frames]: the real
/// dance, in the request's frame. None if it deviates too far from any line to the key.
std::optional<WindowBatch> MakeWindow(const FlowModelParts& model, WindowRequest request,
                                      std::span<const Pose> truth);
/// Batches at least one such window, all of one shape.
WindowBatch Stack(std::vector<WindowBatch> windows);

}  // namespace choreo
