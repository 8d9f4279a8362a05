#pragma once

#include <filesystem>
#include <string>

#include "model/flow/checkpoint/checkpoint.h"
#include "model/papers/networks/frame_flow_model.h"

/// Checkpoints of paper F's flow (see model/flow/checkpoint/checkpoint.h).
namespace choreo {

using Checkpoint = CheckpointOf<FlowModel>;

/// Parses a file's content. `name` is the file's name in errors. Throws Error(kInvalidArgument),
/// which states the cause, for another format version, a wrong hash, or tensors that do not fit the
/// configuration.
Checkpoint ParseCheckpoint(const Safetensors& content, const std::string& name);

/// Writes a checkpoint atomically. Returns the content hash. `card` is JSON. `weights` replace the
/// network's tensors.
std::string SaveCheckpoint(const std::filesystem::path& path, FlowModel& model, Safetensors weights,
                           const nlohmann::json& card);
/// SaveCheckpoint of the network's own tensors.
std::string SaveCheckpoint(const std::filesystem::path& path, FlowModel& model,
                           const nlohmann::json& card);

}  // namespace choreo
