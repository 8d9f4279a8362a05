#pragma once

#include <cstdint>
#include <filesystem>

#include "model/flow/continuous_flow_config.h"
#include "model/motion/skeleton.h"
#include "model/papers/networks/controllers_config.h"
#include "model/papers/networks/flow_config.h"

/// Checkpoints with random weights, the same for the same seed: they dance nothing, but run every
/// path. Their cards say so. For tests and benchmarks.
namespace choreo {

void WriteRandomCheckpoint(const std::filesystem::path& path, const FlowConfig& config,
                           const Skeleton& skeleton, uint64_t seed);
void WriteRandomInbetweener(const std::filesystem::path& path, const FlowConfig& config,
                            const Skeleton& skeleton, uint64_t seed);
void WriteRandomContinuousFlow(const std::filesystem::path& path,
                               const ContinuousFlowConfig& config, const Skeleton& skeleton,
                               uint64_t seed);
void WriteRandomControllers(const std::filesystem::path& path, const ControllersConfig& config,
                            const Skeleton& skeleton, uint64_t seed);

}  // namespace choreo
