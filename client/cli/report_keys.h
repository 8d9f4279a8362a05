#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace choreo::cli {

/// The keys of a dance as in its report (ReportJson), by frame, while the dance is edited.
using ReportKeys = std::map<int64_t, nlohmann::ordered_json>;

/// The keys of the report called `name`, for a dance of this many frames. Throws
/// Error(kInvalidArgument) for a later one.
ReportKeys KeysOf(const nlohmann::ordered_json& report, int64_t frames, const std::string& name);

/// Frames of the key called `id`, or ID@SECOND if several are, and of those after it that hold its
/// pose, in order. Throws Error(kInvalidArgument) with this field unless there is exactly one.
std::vector<int64_t> FindKey(const ReportKeys& keys, const std::string& id, double fps,
                             const std::string& field);

/// Whether a key only holds another one's pose.
bool HoldsAnother(const nlohmann::ordered_json& key);

/// The last key's frame, if it only holds a pose.
std::optional<int64_t> HeldEnd(const ReportKeys& keys);

/// Marks a key as only holding the pose of this id.
void MarkHeld(const std::string& id, nlohmann::ordered_json* key);

}  // namespace choreo::cli
