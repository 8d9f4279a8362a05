#include "model/engine/device_graph.h"

#include <utility>

#ifdef CHOREO_CUDA
#include <ATen/cuda/CUDAGraph.h>
#include <c10/cuda/CUDAGuard.h>
#include <c10/cuda/CUDAStream.h>
#include <torch/cuda.h>
#endif

namespace choreo {

#ifdef CHOREO_CUDA

struct DeviceGraph::Captured {
  explicit Captured(torch::Device device)
      : stream(c10::cuda::getStreamFromPool(/*isHighPriority=*/false, device.index())) {}
  c10::cuda::CUDAStream stream;  // the default one can't be captured
  at::cuda::CUDAGraph graph;
};

DeviceGraph::DeviceGraph(torch::Device device, std::function<void()> work)
    : work_(std::move(work)) {
  if (!device.is_cuda()) return;
  // Weights and tensors may still be on their way there, in other streams.
  torch::cuda::synchronize(device.index());
  captured_ = std::make_unique<Captured>(device);
  const c10::cuda::CUDAStreamGuard guard(captured_->stream);
  // Libraries choose their kernels and take their memory in their first calls.
  for (int i = 0; i < 3; ++i) work_();
  captured_->stream.synchronize();
  captured_->graph.capture_begin();
  work_();
  captured_->graph.capture_end();
}

void DeviceGraph::Run() {
  if (!captured_) return work_();
  const c10::cuda::CUDAStreamGuard guard(captured_->stream);
  captured_->graph.replay();
  captured_->stream.synchronize();
}

#else

struct DeviceGraph::Captured {};

DeviceGraph::DeviceGraph(torch::Device, std::function<void()> work) : work_(std::move(work)) {}

void DeviceGraph::Run() { work_(); }

#endif

DeviceGraph::~DeviceGraph() = default;

}  // namespace choreo
