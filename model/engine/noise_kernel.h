#pragma once

#include <cuda_runtime_api.h>

#include "model/engine/flow_tile.h"

namespace choreo {

/// Draws the noise of `rows` rows into `out` [rows, width], contiguous; both are in the device's
/// memory. Does not wait for it.
void LaunchNoise(const FrameNoise* noise, int rows, int width, float* out, cudaStream_t stream);

}  // namespace choreo
