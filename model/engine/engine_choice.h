#pragma once

#include <array>
#include <compare>
#include <string>
#include <string_view>
#include <vector>

/// What an operator can say of engines: where, and by which code they compute.
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

/// What computes the flows' networks. Paper C's model LibTorch runs, whatever is asked.
enum class EngineKind {
  kAuto,        ///< the fastest: packed on the CPU, in bfloat16 where it can be, else torch
  kTorch,       ///< LibTorch, on any of its devices; the reference that others are held to
  kPacked,      ///< own kernels on packed weights, on the CPU alone, float32
  kPackedBf16,  ///< the same with products of bfloat16, where the CPU has instructions for them
};

/// What they are called, in that order.
inline constexpr std::array<std::string_view, 4> kEngineKindNames = {"auto", "torch", "packed",
                                                                     "packed-bf16"};

/// What the packed engine's kernels are called (PackedKernels::name), slowest first; which of them
/// are here depends on the machine.
inline constexpr std::array<std::string_view, 5> kKernelNames = {"portable", "avx2", "avx512",
                                                                 "avx512_bf16", "amx_bf16"};

/// "auto, torch, ...", for help and messages.
std::string EngineKindNames();
std::string KernelNames();

/// Throws Error(kInvalidArgument, field) for another name.
EngineKind ParseEngineKind(std::string_view text, const std::string& field = "engine");

}  // namespace choreo
