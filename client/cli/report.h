#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "client/cli/written_dance.h"

namespace choreo::cli {

/// A dance's report as JSON:
///   frames, fps                of the dance, at the model's rate; key frames count so
///   output_frames, output_fps  of the file
///   seed, fingerprint
///   keyframes                  id, frame, raw_error_m (of the model's own frame), correction_m
///   (how
///                              far joints were moved on the way), final_error_m, final_error_deg;
///                              output_frame (the file's nearest), on_output_frame (it stands at
///                              the key's time), output_error_m, output_error_deg (measured there)
///   warnings                   frame, message of each
///   measured_from              frame from which on the rest is measured: 0, or where the last
///   server
///                              took over
///   log_likelihood             nats a frame
///   beat_hit_rate, beat_hit_chance  null where there are no beats
///   skate_ratio, max_key_acceleration, p95_acceleration (m/s^2)
///   part_speeds                asked, danced (m a frame) of each part; absent where nothing is
///                              asked
///   first_frame_latency_s, real_time_factor
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
