#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/flow/checkpoint/checkpoint.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/papers/networks/controllers_model.h"

/// Checkpoints of the controllers network (see model/flow/checkpoint/checkpoint.h).
namespace choreo {

struct ControllersCheckpoint : CheckpointOf<ControllersModel> {
  std::array<double, kBodyParts> median_factors = {};  ///< over the training clips, metres a frame
};

/// Whether this file holds a controllers network (by its metadata).
bool HoldsControllers(const Safetensors& content);

/// `name` is the file's name in errors. Throws what ParseCheckpoint throws.
ControllersCheckpoint ParseControllers(const Safetensors& content, const std::string& name);

/// Writes a checkpoint atomically. Returns the content hash.
std::string SaveControllers(const std::filesystem::path& path, ControllersModel& model,
                            const std::array<double, kBodyParts>& median_factors,
                            const nlohmann::json& card);

}  // namespace choreo
