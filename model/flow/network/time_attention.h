#pragma once

#include <torch/types.h>

namespace choreo {

/// Attention over time with a learnt bias per distance. qkv [batch, time, 3 width]: queries, keys,
/// values; `bias` [distances, heads]; `distance` as in TimeDistances → [batch, time, width].
torch::Tensor AttendInTime(const torch::Tensor& qkv, const torch::Tensor& bias,
                           const torch::Tensor& distance);

/// [time, time] indices into bias tables of 2 `most` + 1 distances; larger distances are clipped.
torch::Tensor TimeDistances(int64_t time, torch::Device device, int64_t most);

}  // namespace choreo
