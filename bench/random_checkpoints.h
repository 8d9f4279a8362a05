#pragma once

#include <cstdint>
#include <filesystem>

#include "model/flow/window/continuous_flow_config.h"
#include "model/motion/skeleton.h"
#include "model/papers/networks/controllers_config.h"
#include "model/papers/networks/flow_config.h"

/// Write checkpoints with random weights, the same for the same seed, for tests and benchmarks.
/// They dance nothing useful, but exercise every path. Their cards say so.
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
