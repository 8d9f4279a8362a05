#pragma once

#include <string>
#include <vector>

#include "client/cli/report/time_format.h"
#include "client/cli/report/written_dance.h"

namespace choreo::cli {

/// Formats a dance's report as JSON, in metres, degrees and the model's frames. Each key has its
/// time in seconds and, with a song, its count, the model's error (raw_error_m), how far joints
/// were moved on the way (correction_m), the remaining error, the errors at the file's nearest
/// frame (output_...) and, if it only holds another key's pose, that key (`holds`). `measured_from`
/// is the frame from which the other figures are measured: 0, or where the last server took over.
/// `motion_sketch` is a MotionSketch, with which edits recognise the dance. Beats are null if there
/// are none. `part_speeds` is absent without velocity factors. Figures are absent if the server was
/// lost.
std::string ReportJson(const WrittenDance& dance);

/// Passes warnings to people as notes (notes.h).
void ShowWarnings(const std::vector<client::Warning>& warnings, const TimeFormat& times);
std::string Describe(const client::Warning& warning, const TimeFormat& times);

/// Summarises a report in a few lines for people.
std::string ReportText(const WrittenDance& dance);

}  // namespace choreo::cli
