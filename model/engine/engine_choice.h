#pragma once

#include <array>
#include <compare>
#include <string>
#include <string_view>
#include <vector>

/// The operator's choice of devices and engines.
namespace choreo {

/// The device on which an engine computes.
struct Device {
  enum class Kind { kCpu, kCuda };
  Kind kind = Kind::kCpu;
  int index = 0;  ///< the CUDA device's index; 0 for the CPU

  std::string name() const;  ///< "cpu", "cuda:0"
  auto operator<=>(const Device&) const = default;
};

/// The devices that this build can use on this machine.
struct AvailableDevices {
  bool cuda_build = false;  ///< compiled against a LibTorch with CUDA
  int cuda_devices = 0;     ///< devices that respond now
};

/// Parses `auto | cpu | cuda:N[,M...]`, such as "cuda:0,1". `auto` is every CUDA device, or the CPU
/// without one. Throws Error(kInvalidArgument, field) for another form or a device named twice, and
/// Error(kNotFound, field), listing the existing ones, for a device that does not exist.
std::vector<Device> ParseDevices(std::string_view text, const AvailableDevices& available,
                                 const std::string& field = "--device");

/// The engine that computes the flows' networks. LibTorch always runs paper C's model.
enum class EngineKind {
  kAuto,        ///< the fastest: packed on the CPU, in bfloat16 if possible; else torch
  kTorch,       ///< LibTorch, on any of its devices; the reference for the others
  kPacked,      ///< own kernels on packed weights, CPU only, float32
  kPackedBf16,  ///< packed with bfloat16 products, if the CPU has instructions for them
};

/// The names of EngineKind's values, in order.
inline constexpr std::array<std::string_view, 4> kEngineKindNames = {"auto", "torch", "packed",
                                                                     "packed-bf16"};

/// The names of the packed engine's kernels (PackedKernels::name), slowest first. A machine may
/// support only some.
inline constexpr std::array<std::string_view, 5> kKernelNames = {"portable", "avx2", "avx512",
                                                                 "avx512_bf16", "amx_bf16"};

/// All names, as "auto, torch, ...", for help and messages.
std::string EngineKindNames();
std::string KernelNames();

/// The engine with this name. Throws Error(kInvalidArgument, field) for an unknown name.
EngineKind ParseEngineKind(std::string_view text, const std::string& field = "engine");

}  // namespace choreo
