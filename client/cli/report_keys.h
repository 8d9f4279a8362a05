#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "client/authoring/counts.h"
#include "model/fit/finger_bones.h"

namespace choreo::cli {

/// The keys of a dance as in its report (ReportJson), by frame, while the dance is edited.
using ReportKeys = std::map<int64_t, nlohmann::ordered_json>;

/// The keys of the report called `name`, for a dance of this many frames, of which `missing` more
/// are lost in its file: keys there stand at the last frame. Throws Error(kInvalidArgument) for a
/// later one.
ReportKeys KeysOf(const nlohmann::ordered_json& report, int64_t frames, const std::string& name,
                  int64_t missing = 0);

/// Frames of the key called `id`, or ID@TIME if several are, and of those after it that hold its
/// pose, in order. ID@TIME means the nearest, at most half a count or kTooNear (key_file.h) away.
/// Throws Error(kInvalidArgument) with this field unless there is exactly one, and for a TIME in
/// counts that these do not have.
std::vector<int64_t> FindKey(const ReportKeys& keys, const std::string& id, double fps,
                             const std::string& field, const authoring::Counts& counts);

/// Whether a key only holds another one's pose.
bool HoldsAnother(const nlohmann::ordered_json& key);

/// The last key's frame, if it only holds a pose.
std::optional<int64_t> HeldEnd(const ReportKeys& keys);

/// Marks a key as only holding the pose of this id.
void MarkHeld(const std::string& id, nlohmann::ordered_json* key);

/// How hard a key is hit, if it states that.
std::optional<double> HitOf(const nlohmann::ordered_json& key);
void MarkHit(const std::optional<double>& hit, nlohmann::ordered_json* key);

/// The hands' pose at a key, if it states one.
std::optional<HandPose> HandsOf(const nlohmann::ordered_json& key);
void MarkHands(const std::optional<HandPose>& hands, nlohmann::ordered_json* key);

/// Marks a key as another one is marked: as holding a pose, hit, and with hands.
void CopyMarks(const nlohmann::ordered_json& from, nlohmann::ordered_json* to);

/// The hands' poses in a dance, from its report's keys (ReadReport), in order of time.
std::vector<HandKey> HandKeys(const nlohmann::ordered_json& report);

}  // namespace choreo::cli
