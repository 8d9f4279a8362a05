#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "client/cli/told_times.h"
#include "client/cli/written_dance.h"

namespace choreo::cli {

/// A dance's report as JSON, in metres, degrees and the model's frames. Per key: the model's error
/// (raw_error_m), how far joints were moved on the way (correction_m), the remaining error;
/// `holds`: the key whose pose it only holds, if any; output_... is measured at the file's nearest
/// frame. `measured_from`: the frame from which on the rest is measured, 0 or where the last server
/// took over. `motion_sketch`: a MotionSketch, by which edits know the dance. Beats are null if
/// there are none, `part_speeds` is absent without velocity factors; figures are absent if the
/// server was lost.
std::string ReportJson(const WrittenDance& dance);

/// One key of such a report, without what is measured in the file.
nlohmann::ordered_json KeyJson(const client::KeyReached& key);

/// The warnings of such a report, by frame.
nlohmann::ordered_json WarningsJson(std::vector<client::Warning> warnings);
/// The same on stderr, one per line, for people.
void ShowWarnings(const std::vector<client::Warning>& warnings, const ToldTimes& times);
std::string Told(const client::Warning& warning, const ToldTimes& times);

/// The sketch in such a report; earlier versions wrote none. Throws Error(kInvalidArgument) whose
/// field begins with the path.
void WriteSketch(const MotionSketch& sketch, nlohmann::ordered_json* report);
MotionSketch ReadSketch(const nlohmann::ordered_json& report, const std::filesystem::path& path);

/// Notes where a dance looks otherwise than its report says. Throws Error(kInvalidArgument), whose
/// field is the path, for the report of another one: most of the sketch differs.
void CheckSketch(const std::filesystem::path& path, const nlohmann::ordered_json& report,
                 const Motion& file);

/// A report written by ReportJson, with valid fps and keyframes. Throws Error(kInvalidArgument)
/// whose field begins with the path.
nlohmann::ordered_json ReadReport(const std::filesystem::path& path);
/// The warnings in such a report, from `path`. Throws Error(kInvalidArgument) likewise.
std::vector<client::Warning> ReadWarnings(const nlohmann::ordered_json& report,
                                          const std::filesystem::path& path);

/// A few lines for people.
std::string ReportText(const WrittenDance& dance);

}  // namespace choreo::cli
