#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "client/cli/told_times.h"
#include "client/cli/written_dance.h"

namespace choreo::cli {

/// Formats a dance's report as JSON, in metres, degrees and the model's frames. Each key has the
/// model's error (raw_error_m), how far joints were moved on the way (correction_m), the remaining
/// error, `holds`, the key whose pose it only holds, if any, and errors at the file's nearest frame
/// (output_...). `measured_from` is the frame from which the other figures are measured: 0, or
/// where the last server took over. `motion_sketch` is a MotionSketch, with which edits recognise
/// the dance. Beats are null if there are none. `part_speeds` is absent without velocity factors.
/// Figures are absent if the server was lost.
std::string ReportJson(const WrittenDance& dance);

/// Formats one key of a report, without the figures measured in the file.
nlohmann::ordered_json KeyJson(const client::KeyReached& key);

/// Formats the warnings of a report, sorted by frame.
nlohmann::ordered_json WarningsJson(std::vector<client::Warning> warnings);
/// Prints warnings on stderr for people, one per line.
void ShowWarnings(const std::vector<client::Warning>& warnings, const ToldTimes& times);
std::string Told(const client::Warning& warning, const ToldTimes& times);

/// Write and read the sketch in a report; earlier versions wrote none. ReadSketch throws
/// Error(kInvalidArgument) whose field begins with the path.
void WriteSketch(const MotionSketch& sketch, nlohmann::ordered_json* report);
MotionSketch ReadSketch(const nlohmann::ordered_json& report, const std::filesystem::path& path);

/// Prints a note of where a dance differs from the sketch in its report. Throws
/// Error(kInvalidArgument), whose field is the path, for the report of another dance: one of which
/// most of the sketch differs.
void CheckSketch(const std::filesystem::path& path, const nlohmann::ordered_json& report,
                 const Motion& file);

/// Reads a report that ReportJson wrote. Throws Error(kInvalidArgument), whose field begins with
/// the path, unless its fps and keyframes are valid.
nlohmann::ordered_json ReadReport(const std::filesystem::path& path);
/// Reads the warnings in the report from `path`. Throws Error(kInvalidArgument) whose field begins
/// with the path.
std::vector<client::Warning> ReadWarnings(const nlohmann::ordered_json& report,
                                          const std::filesystem::path& path);

/// Summarises a report in a few lines for people.
std::string ReportText(const WrittenDance& dance);

}  // namespace choreo::cli
