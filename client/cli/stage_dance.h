#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "client/cli/dance_performance.h"
#include "client/cli/dancers.h"

/// Several dancers on one stage: each dance that differs is danced once, from the origin; then it
/// is mirrored, delayed and put where each dancer stands. Turned and moved a dance stays what it
/// is, so that nothing of it has to be danced anew. Where bodies would come too near each other the
/// whole formation is widened about its middle, and that is said.
namespace choreo::cli {

/// FILE.ID.npz of each dancer; of a .glb, which holds all of them, the one file.
std::vector<std::filesystem::path> OutputsOf(const Dancers& stage,
                                             const std::filesystem::path& out);
/// FILE.ID.json of each; none where there is no report.
std::vector<std::filesystem::path> ReportsOf(const Dancers& stage,
                                             const std::filesystem::path& report);

/// Dances, writes all of it, and says how near bodies come. Errors as Perform; those of a dancer's
/// `after` name the file.
void DanceTogether(const DanceOptions& options, const Dancers& stage,
                   const std::optional<Music>& music, const Connection& connection,
                   const std::filesystem::path& out);

}  // namespace choreo::cli
