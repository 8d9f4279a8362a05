#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "client/authoring/dancers.h"
#include "client/cli/dance_performance.h"

/// Several dancers on one stage: dances each different dance once, from the origin, and mirrors,
/// delays and moves it for each dancer. Moving and turning changes nothing, so nothing is danced
/// again. If bodies would come too near each other, widens the whole formation about its middle,
/// and reports that.
namespace choreo::cli {

/// FILE.ID.npz for each dancer; for a .glb, which holds all of them, one file.
std::vector<std::filesystem::path> OutputsOf(const authoring::Dancers& stage,
                                             const std::filesystem::path& out);
/// FILE.ID.json for each; empty without a report.
std::vector<std::filesystem::path> ReportsOf(const authoring::Dancers& stage,
                                             const std::filesystem::path& report);

/// Dances, writes everything, and reports how near bodies come. Fails like Perform; errors of a
/// dancer's `after` name the file.
void DanceTogether(const DanceOptions& options, const authoring::Dancers& stage,
                   const std::optional<authoring::Music>& music, const Connection& connection,
                   const std::filesystem::path& out);

}  // namespace choreo::cli
