#pragma once

#include <cstdint>
#include <filesystem>

#include "model/controllers/controllers_config.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Writes a checkpoint with weights drawn at random, as WriteRandomCheckpoint does for the flow:
/// for tests and benchmarks.
void WriteRandomControllers(const std::filesystem::path& path, const ControllersConfig& config,
                            const Skeleton& skeleton, uint64_t seed);

}  // namespace choreo
