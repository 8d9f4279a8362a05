#pragma once

#include <cstdint>
#include <filesystem>

#include "model/flow/continuous_flow_config.h"
#include "model/flow/flow_config.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Writes a checkpoint with weights drawn at random, the same for the same seed: it dances nothing,
/// but every path computes. For tests and benchmarks; its card says so.
void WriteRandomCheckpoint(const std::filesystem::path& path, const FlowConfig& config,
                           const Skeleton& skeleton, uint64_t seed);

/// The same of a continuous flow.
void WriteRandomContinuousFlow(const std::filesystem::path& path,
                               const ContinuousFlowConfig& config, const Skeleton& skeleton,
                               uint64_t seed);

}  // namespace choreo
