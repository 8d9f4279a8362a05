#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/engine/engine_choice.h"
#include "model/engine/sampler.h"

/// Makes the samplers that run the continuous flow (model/flow) and the papers' networks
/// (model/papers); the checkpoint says which. This header is free of torch.
///
/// A row's bits don't depend on the rows beside it. That is verified of our own kernels when
/// samplers are made, with random rows in every place; where it doesn't hold, slower kernels are
/// taken.
namespace choreo {

/// What LibTorch can use here.
AvailableDevices TorchDevices();

/// Threads of one of LibTorch's matrix products or operations, process-wide. Call before anything
/// is sampled. Throws Error(kInvalidArgument) unless threads is in [1, kMaxMathThreads].
void SetTorchThreads(int threads);

/// Loads a checkpoint once and makes a sampler on each device; those of one device share its
/// weights. `kernels`: a PackedKernels::name, so that packed engines on different CPUs have one
/// fingerprint; empty: the fastest here; what LibTorch runs is left alone. Throws as
/// ReadSafetensors and ParseContinuousFlow (model/flow/continuous_flow.h) do, and
/// Error(kInvalidArgument) for a kind or kernels that the device or this machine does not have.
std::vector<std::unique_ptr<Sampler>> MakeSamplers(const std::filesystem::path& checkpoint,
                                                   std::span<const Device> devices,
                                                   EngineKind kind = EngineKind::kAuto,
                                                   const std::string& kernels = "");
/// Which of the settings of MakeSamplers this kind of sampler uses; it ignores the others.
struct UsedSettings {
  bool kind = false;     ///< by flows; LibTorch runs paper C's network and the baseline
  bool kernels = false;  ///< by packed flows
};
UsedSettings SettingsUsedBy(const Sampler& sampler);

std::unique_ptr<Sampler> MakeSampler(const std::filesystem::path& checkpoint, const Device& device,
                                     EngineKind kind = EngineKind::kAuto);

}  // namespace choreo
