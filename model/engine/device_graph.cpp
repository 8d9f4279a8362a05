#include "model/engine/device_graph.h"

#include <utility>

#include "model/core/error.h"

#ifdef CHOREO_CUDA
#include <ATen/cuda/CUDAGraph.h>
#include <ATen/detail/CUDAHooksInterface.h>
#include <c10/cuda/CUDAException.h>
#include <c10/cuda/CUDAGuard.h>
#include <c10/cuda/CUDAStream.h>
#include <cuda_runtime_api.h>
#include <torch/cuda.h>

#include <exception>
#include <iostream>
#endif

namespace choreo {

#ifdef CHOREO_CUDA

std::string DescribeCuda(torch::Device device) {
  cudaDeviceProp properties{};
  int runtime = 0, driver = 0;
  C10_CUDA_CHECK(cudaGetDeviceProperties(&properties, device.index()));
  C10_CUDA_CHECK(cudaRuntimeGetVersion(&runtime));
  C10_CUDA_CHECK(cudaDriverGetVersion(&driver));
  return std::string(properties.name) + ' ' + std::to_string(properties.major) + '.' +
         std::to_string(properties.minor) + ", CUDA " + std::to_string(runtime) + ", driver " +
         std::to_string(driver) + ", cuDNN " +
         std::to_string(at::detail::getCUDAHooks().versionCuDNN());
}

struct DeviceGraph::Captured {
  explicit Captured(torch::Device device)
      : stream(c10::cuda::getStreamFromPool(/*isHighPriority=*/false, device.index())) {}
  c10::cuda::CUDAStream stream;                // the default one can't be captured
  std::unique_ptr<at::cuda::CUDAGraph> graph;  // null: launched kernel by kernel
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
  auto graph = std::make_unique<at::cuda::CUDAGraph>();
  std::string failure;
  graph->capture_begin();
  try {
    work_();
  } catch (const std::exception& error) {
    failure = error.what();
  }
  // Ends the stream's capture in any case.
  try {
    graph->capture_end();
  } catch (const std::exception& error) {
    if (failure.empty()) failure = error.what();
  }
  if (failure.empty()) {
    captured_->graph = std::move(graph);
    return;
  }
  cudaGetLastError();  // it is told here, and not by the next call
  std::clog << "choreo: on " << device
            << " a step can't be captured as a graph, so its kernels are "
            << "launched one by one (slower): " << failure << std::endl;
}

void DeviceGraph::Run() {
  if (!captured_) return work_();
  const c10::cuda::CUDAStreamGuard guard(captured_->stream);
  if (captured_->graph) {
    captured_->graph->replay();
  } else {
    work_();
  }
  captured_->stream.synchronize();
}

#else

std::string DescribeCuda(torch::Device device) {
  throw Error(ErrorCode::kNotFound, "device", device.str() + " in a build without CUDA");
}

struct DeviceGraph::Captured {};

DeviceGraph::DeviceGraph(torch::Device, std::function<void()> work) : work_(std::move(work)) {}

void DeviceGraph::Run() { work_(); }

#endif

DeviceGraph::~DeviceGraph() = default;

}  // namespace choreo
