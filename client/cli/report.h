#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "client/choreo_client.h"

namespace choreo::cli {

/// A dance's report as JSON: frames, fps, seed, fingerprint, keyframes (id, frame, raw_error_m,
/// final_error_m, final_error_deg), log_likelihood (nats a frame), beat_hit_rate (null where there
/// are no beats), skate_ratio, first_frame_latency_s, real_time_factor. Frames are counted at the
/// model's rate, `fps`.
std::string ReportJson(const client::Header& header, const client::Report& report);

/// One key of such a report.
nlohmann::ordered_json KeyJson(const client::KeyReached& key);

/// A report that ReportJson wrote: its fps and keyframes are as they should be. Throws
/// Error(kInvalidArgument) whose field begins with the path.
nlohmann::ordered_json ReadReport(const std::filesystem::path& path);

/// A few lines for people.
std::string ReportText(const client::Header& header, const client::Report& report);

/// Throws Error(kInternal) where the file cannot be written.
void WriteText(const std::filesystem::path& path, const std::string& text);

}  // namespace choreo::cli
