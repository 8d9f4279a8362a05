#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "client/authoring/project/dancers.h"
#include "client/cli/dance/dance_performance.h"

/// Dances for several dancers on one stage. Generates each different dance once, from the origin,
/// then mirrors, delays, turns and moves it for each dancer. If bodies would come too near each
/// other, widens the whole formation about its middle, and prints a note.
namespace choreo::cli {

/// The output files: FILE.ID.npz for each dancer, or one .glb with all of them.
std::vector<std::filesystem::path> OutputsOf(const authoring::Dancers& stage,
                                             const std::filesystem::path& out);
/// The report files: FILE.ID.json for each dancer; empty without a report.
std::vector<std::filesystem::path> ReportsOf(const authoring::Dancers& stage,
                                             const std::filesystem::path& report);

/// Generates and writes all dances, and prints how near bodies come to each other. Throws as
/// Perform does; errors of a dancer's `after` name the file.
void DanceTogether(const DanceOptions& options, const authoring::Dancers& stage,
                   const std::optional<authoring::Music>& music, const Connection& connection,
                   const std::filesystem::path& out);

}  // namespace choreo::cli
