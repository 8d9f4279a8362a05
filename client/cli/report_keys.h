#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace choreo::cli {

/// The keys of a dance as its report has them (ReportJson), by frame, while the dance is edited.
using ReportKeys = std::map<int64_t, nlohmann::ordered_json>;

/// Those of the report called `name`, whose dance has so many frames. Throws
/// Error(kInvalidArgument) for one behind them.
ReportKeys KeysOf(const nlohmann::ordered_json& report, int64_t frames, const std::string& name);

/// Frames of the key called `id`, or ID@SECOND where several are, and of those behind it that hold
/// its pose, in time. Throws Error(kInvalidArgument) of this field where there is not one.
std::vector<int64_t> FindKey(const ReportKeys& keys, const std::string& id, double fps,
                             const std::string& field);

/// Whether a key only holds the pose of another one.
bool HoldsAnother(const nlohmann::ordered_json& key);

/// The last key's frame, if it only holds a pose.
std::optional<int64_t> HeldEnd(const ReportKeys& keys);

/// A key that only holds the pose of this id.
void MarkHeld(const std::string& id, nlohmann::ordered_json* key);

}  // namespace choreo::cli
