#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/engine/engine_choice.h"
#include "model/plan/sampler.h"

/// Makes samplers from checkpoints: of the continuous flow (model/flow) or the papers' networks
/// (model/papers). This header is free of torch.
///
/// A row's bits don't depend on its neighbours in a batch. Making a sampler verifies this for our
/// own kernels with random rows in every place, and falls back to slower kernels if it fails.
namespace choreo {

/// The devices that LibTorch can use here.
AvailableDevices TorchDevices();

/// Sets LibTorch's threads per matrix product or operation, process-wide. Call before sampling
/// anything. Throws Error(kInvalidArgument) unless threads is in [1, kMaxMathThreads].
void SetTorchThreads(int threads);

/// Loads a checkpoint once and makes one sampler per device; samplers on the same device share
/// weights. `kernels`: a PackedKernels::name, which gives packed engines on different CPUs one
/// fingerprint; empty: the fastest here. It does not affect LibTorch. `notes` gets
/// FirstIndependent's notes (model/engine/loading.h), and what is wrong with the file of
/// ReadStyleFigures, which changes nothing else. Throws like ReadSafetensors and
/// ParseContinuousFlow (model/flow/network/continuous_flow.h) do, and Error(kInvalidArgument) for a
/// kind or kernels that the device or machine lacks.
std::vector<std::unique_ptr<Sampler>> MakeSamplers(const std::filesystem::path& checkpoint,
                                                   std::span<const Device> devices,
                                                   EngineKind kind = EngineKind::kAuto,
                                                   const std::string& kernels = "",
                                                   std::vector<std::string>* notes = nullptr);
/// The MakeSamplers settings that this kind of sampler uses; it ignores the others.
struct UsedSettings {
  bool kind = false;     ///< by flows; LibTorch runs paper C's network and the baseline
  bool kernels = false;  ///< by packed flows
};
UsedSettings SettingsUsedBy(const Sampler& sampler);

std::unique_ptr<Sampler> MakeSampler(const std::filesystem::path& checkpoint, const Device& device,
                                     EngineKind kind = EngineKind::kAuto);

}  // namespace choreo
