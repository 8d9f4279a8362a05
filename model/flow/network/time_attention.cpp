#include "model/flow/network/time_attention.h"

#include <cmath>

namespace choreo {

using torch::Tensor;

Tensor AttendInTime(const Tensor& qkv, const Tensor& bias, const Tensor& distance) {
  const int64_t batch = qkv.size(0), time = qkv.size(1), width = qkv.size(2) / 3;
  const int64_t heads = bias.size(1);
  // [3, batch, heads, time, head width]
  const Tensor parts = qkv.view({batch, time, 3, heads, width / heads}).permute({2, 0, 3, 1, 4});
  const Tensor added =
      bias.index_select(0, distance.flatten()).view({time, time, heads}).permute({2, 0, 1});
  const double scale = 1 / std::sqrt(static_cast<double>(width / heads));
  const Tensor attention =
      torch::softmax(torch::matmul(parts[0] * scale, parts[1].transpose(-1, -2)) + added, -1);
  return torch::matmul(attention, parts[2]).transpose(1, 2).reshape({batch, time, width});
}

Tensor TimeDistances(int64_t time, torch::Device device, int64_t most) {
  const Tensor steps =
      torch::arange(time, torch::TensorOptions().dtype(torch::kLong).device(device));
  return (steps.unsqueeze(0) - steps.unsqueeze(1)).clamp(-most, most) + most;
}

}  // namespace choreo
