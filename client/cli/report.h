#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "client/cli/written_dance.h"

namespace choreo::cli {

/// A dance's report as JSON, in metres, degrees and the model's frames. Of a key: what the model
/// missed it by (raw_error_m), how far joints were moved on the way (correction_m), what is left;
/// `holds`: the key whose pose it only holds, if it does; output_... is measured at the file's
/// nearest frame. `measured_from`: the frame from which on the rest is measured, 0 or where the
/// last server took over. Beats are null where there are none, `part_speeds` is absent where
/// nothing is asked.
std::string ReportJson(const WrittenDance& dance);

/// One key of such a report, without what is measured in the file.
nlohmann::ordered_json KeyJson(const client::KeyReached& key);

/// The warnings of such a report, by frame.
nlohmann::ordered_json WarningsJson(std::vector<client::Warning> warnings);
/// The same on stderr, a line each.
void ShowWarnings(const std::vector<client::Warning>& warnings);

/// A report that ReportJson wrote: its fps and keyframes are as they should be. Throws
/// Error(kInvalidArgument) whose field begins with the path.
nlohmann::ordered_json ReadReport(const std::filesystem::path& path);
/// What such a report, that of `path`, warns of. Throws Error(kInvalidArgument) likewise.
std::vector<client::Warning> ReadWarnings(const nlohmann::ordered_json& report,
                                          const std::filesystem::path& path);

/// A few lines for people.
std::string ReportText(const WrittenDance& dance);

}  // namespace choreo::cli
