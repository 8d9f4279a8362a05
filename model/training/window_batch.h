#pragma once

#include <torch/types.h>

#include <span>
#include <string>
#include <vector>

#include "model/flow/flow_sampler.h"

namespace choreo {

/// A batch of windows of equal shape as the continuous flow sees them; see FlowNetwork for what
/// the tensors are. Time stands before features, float32.
struct WindowBatch {
  int frames = 0, to_key = 0;
  torch::Tensor z = {};                     ///< [batch, w, dimensions] real motion, white
  torch::Tensor scales = {};                ///< [batch, dimensions] as FlowWindow has them
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

/// Fills a batch, window by window.
class WindowBatchBuilder {
 public:
  WindowBatchBuilder(const FlowModelParts& model, int frames, int to_key);

  /// `truth` [frames]: what was danced there, in the request's frame. False, and nothing is added,
  /// where it strays from any line to the key.
  bool Add(WindowRequest request, std::span<const Pose> truth);
  int size() const { return static_cast<int>(z_.size()); }
  WindowBatch Build();

 private:
  const FlowModelParts& model_;
  WindowBatch batch_;
  std::vector<float> staged_;
  std::vector<torch::Tensor> z_, scales_, keyed_, mean_, features_, whole_, history_joints_,
      base_root_, base_turns_, axes_, bones_;
};

}  // namespace choreo
