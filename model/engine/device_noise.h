#pragma once

#include <torch/types.h>

#include <span>

#include "model/engine/flow_tile.h"

namespace choreo {

/// Noise of a tile's rows, drawn on the device that steps them: FillNormal's numbers, on CUDA to
/// within a rounding of float32. Not thread-safe.
class DeviceNoise {
 public:
  DeviceNoise(torch::Device device, int rows, int width);

  /// Which noise each row has from the next Draw on, in host memory.
  std::span<FrameNoise> rows();
  /// Draws it into values(); can be captured in a DeviceGraph.
  void Draw();
  /// [rows, width], on the device.
  const torch::Tensor& values() const { return values_; }

 private:
  torch::Tensor keys_;         // bytes of FrameNoise, pinned for CUDA
  torch::Tensor device_keys_;  // the same on CUDA
  torch::Tensor values_;
};

}  // namespace choreo
