#include "model/engine/device_noise.h"

#include <torch/torch.h>

#include <type_traits>

#ifdef CHOREO_CUDA
#include <c10/cuda/CUDAException.h>
#include <c10/cuda/CUDAStream.h>

#include "model/engine/noise_kernel.h"
#endif

namespace choreo {

static_assert(std::is_trivially_copyable_v<FrameNoise>);

DeviceNoise::DeviceNoise(torch::Device device, int rows, int width)
    : values_(torch::zeros({rows, width}, device)) {
  const auto bytes = torch::TensorOptions(torch::kByte);
  keys_ = torch::zeros({rows * static_cast<int64_t>(sizeof(FrameNoise))},
                       bytes.pinned_memory(device.is_cuda()));
  if (device.is_cuda()) device_keys_ = torch::zeros_like(keys_, bytes.device(device));
}

std::span<FrameNoise> DeviceNoise::rows() {
  return {reinterpret_cast<FrameNoise*>(keys_.data_ptr<uint8_t>()),
          static_cast<size_t>(values_.size(0))};
}

void DeviceNoise::Draw() {
  const auto width = static_cast<size_t>(values_.size(1));
  if (!values_.is_cuda()) {
    float* row = values_.data_ptr<float>();
    for (const FrameNoise& noise : rows()) {
      noise.Fill({row, width});
      row += width;
    }
    return;
  }
#ifdef CHOREO_CUDA
  device_keys_.copy_(keys_, /*non_blocking=*/true);
  LaunchNoise(reinterpret_cast<const FrameNoise*>(device_keys_.data_ptr<uint8_t>()),
              static_cast<int>(values_.size(0)), static_cast<int>(width), values_.data_ptr<float>(),
              c10::cuda::getCurrentCUDAStream(values_.device().index()));
  C10_CUDA_KERNEL_LAUNCH_CHECK();
#endif
}

}  // namespace choreo
