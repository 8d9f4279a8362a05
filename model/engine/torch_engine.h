#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "model/engine/devices.h"
#include "model/engine/step_engine.h"

/// The engine that runs the flow model (model/flow) with LibTorch, on any of its devices. This
/// header is free of torch. It is also the reference that faster engines are held to.
///
/// Rows are stepped in tiles of one fixed size, padded, so that a row's bits depend neither on its
/// slot nor on who steps with it. That is verified when an engine is made, with random rows in
/// every place; where it doesn't hold, tiles shrink to one row, and standard error says so.
namespace choreo {

/// What LibTorch can use here.
AvailableDevices TorchDevices();

/// Threads of one matrix product or network operation, process-wide. Call before engines step.
/// Throws Error(kInvalidArgument) unless threads is in [1, 1024].
void SetTorchThreads(int threads);

/// Loads a checkpoint once and makes an engine on each device, with `slots` slots each; engines of
/// one device share its weights. Throws as LoadCheckpoint does (model/flow/checkpoint.h), and
/// Error(kInvalidArgument) unless slots is in [1, 4096].
std::vector<std::unique_ptr<StepEngine>> MakeTorchEngines(const std::filesystem::path& checkpoint,
                                                          std::span<const Device> devices,
                                                          int slots);
std::unique_ptr<StepEngine> MakeTorchEngine(const std::filesystem::path& checkpoint,
                                            const Device& device, int slots);

}  // namespace choreo
