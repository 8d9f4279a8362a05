#pragma once

#include <array>
#include <string>
#include <string_view>

namespace choreo {

/// What computes the flows' networks. Paper C's model LibTorch runs, whatever is asked.
enum class EngineKind {
  kAuto,        ///< the faster one: packed on the CPU, else torch
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

/// "auto, torch, ...", for messages.
std::string EngineKindNames();

/// Throws Error(kInvalidArgument, field) for another name.
EngineKind ParseEngineKind(std::string_view text, const std::string& field = "engine");

}  // namespace choreo
