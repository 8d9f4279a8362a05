#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/training/curves.h"
#include "model/training/prepared_clip.h"
#include "model/training/train_options.h"

namespace choreo {

/// What a checkpoint says of itself: data and their terms, the command, figures on validation
/// clips, `limits`, and `from`, what it went on from ({"hash", "card"}), whose terms bind it, too.
/// `hash` is that of the training clips.
nlohmann::json ModelCard(const TrainOptions& options, const std::vector<PreparedClip>& clips,
                         const std::string& hash, const NamedFigures& figures,
                         const std::string& limits, const nlohmann::json& from = {});

}  // namespace choreo
