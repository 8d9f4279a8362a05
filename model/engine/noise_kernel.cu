#include "model/core/philox.h"
#include "model/engine/noise_kernel.h"

namespace choreo {
namespace {

constexpr int kThreads = 128;

// A thread draws four neighbouring dimensions of a row: a block of Philox.
__global__ void Draw(const FrameNoise* noise, int rows, int width, float* out) {
  const int blocks = (width + 3) / 4;
  const int at = blockIdx.x * blockDim.x + threadIdx.x;
  if (at >= rows * blocks) return;
  const int row = at / blocks, block = at % blocks;
  const FrameNoise& key = noise[row];
  float z[4];
  philox::FrameNormals(key.seed, key.candidate, key.frame, static_cast<uint32_t>(block), z);
  for (int i = 0; i < 4 && 4 * block + i < width; ++i)
    out[row * width + 4 * block + i] = key.spread * z[i];
}

}  // namespace

void LaunchNoise(const FrameNoise* noise, int rows, int width, float* out, cudaStream_t stream) {
  const int threads = rows * ((width + 3) / 4);
  Draw<<<(threads + kThreads - 1) / kThreads, kThreads, 0, stream>>>(noise, rows, width, out);
}

}  // namespace choreo
