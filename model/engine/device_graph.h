#pragma once

#include <torch/types.h>

#include <functional>
#include <memory>
#include <string>

namespace choreo {

/// What can change a bit of what a CUDA device computes: its name, its capability, the versions of
/// runtime, driver and cuDNN. Throws Error(kNotFound) in a build without CUDA.
std::string DescribeCuda(torch::Device device);

/// The same work on one device, again and again on the same tensors. A step of the flow is hundreds
/// of small kernels, which take a GPU less time than a CPU needs to launch them: on CUDA they are
/// captured once as a graph and launched together. On the CPU the work is just called. Not
/// thread-safe.
class DeviceGraph {
 public:
  /// Does the work a few times to capture it, on CUDA. It must read and write tensors that outlive
  /// the graph, and may neither wait for the device nor depend on what it finds there. Where it
  /// can't be captured, that is logged, and it is launched kernel by kernel.
  DeviceGraph(torch::Device device, std::function<void()> work);
  ~DeviceGraph();
  DeviceGraph(const DeviceGraph&) = delete;
  DeviceGraph& operator=(const DeviceGraph&) = delete;

  /// Does the work; when this returns, it is done.
  void Run();

 private:
  struct Captured;
  std::function<void()> work_;
  std::unique_ptr<Captured> captured_;  // null on the CPU
};

}  // namespace choreo
