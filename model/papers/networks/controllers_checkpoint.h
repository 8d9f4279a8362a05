#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/flow/checkpoint.h"
#include "model/motion/velocity_factors.h"
#include "model/papers/networks/controllers_model.h"

/// Checkpoints of the controllers network, as those of the other networks
/// (model/flow/checkpoint.h): one safetensors file that has everything, guarded by a content hash.
namespace choreo {

struct ControllersCheckpoint : CheckpointOf<ControllersModel> {
  std::array<double, kBodyParts> median_factors = {};  ///< of the training clips, metres a frame
};

/// Whether this file holds a controllers network (by its metadata).
bool HoldsControllers(const Safetensors& content);

/// `name` is what errors call it. Throws as ParseCheckpoint does.
ControllersCheckpoint ParseControllers(const Safetensors& content, const std::string& name);

/// Writes atomically; returns the content hash.
std::string SaveControllers(const std::filesystem::path& path, ControllersModel& model,
                            const std::array<double, kBodyParts>& median_factors,
                            const nlohmann::json& card);

}  // namespace choreo
