#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

namespace choreo {

/// Where an engine computes.
struct Device {
  enum class Kind { kCpu, kCuda };
  Kind kind = Kind::kCpu;
  int index = 0;  ///< of the CUDA device; 0 for the CPU

  std::string name() const;  ///< "cpu", "cuda:0"
  auto operator<=>(const Device&) const = default;
};

/// What this build can use on this machine.
struct AvailableDevices {
  bool cuda_build = false;  ///< compiled against a LibTorch with CUDA
  int cuda_devices = 0;     ///< that answer now
};

/// Reads `auto | cpu | cuda:N[,M...]`, as in "cuda:0,1". `auto` is every CUDA device, or the CPU
/// where there is none. Throws Error(kInvalidArgument, field) for another form or a device named
/// twice, and Error(kNotFound, field) for one that is not there; the message says what is.
std::vector<Device> ParseDevices(std::string_view text, const AvailableDevices& available,
                                 const std::string& field = "--device");

}  // namespace choreo
