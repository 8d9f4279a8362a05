#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "model/training/prepared_clip.h"
#include "model/training/report_row.h"
#include "model/training/train_options.h"

namespace choreo {

/// What a checkpoint says of itself: data and their terms, the command, steps, figures on
/// validation clips, `limits`. `hash` is that of the training clips.
nlohmann::json ModelCard(const TrainOptions& options, int64_t planner_steps, int64_t flow_steps,
                         const std::vector<PreparedClip>& clips, const std::string& hash,
                         const std::vector<ValidationRow>& rows, const std::string& limits);

}  // namespace choreo
