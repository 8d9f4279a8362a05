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

/// The keys of a dance that is being edited, by frame, as in its report (ReportJson).
using ReportKeys = std::map<int64_t, nlohmann::ordered_json>;

/// Reads the keys of the report called `name`, for a dance of `frames`. Its file lacks `missing`
/// further frames: keys at these move to the last frame. Throws Error(kInvalidArgument) for a later
/// key.
ReportKeys KeysOf(const nlohmann::ordered_json& report, int64_t frames, const std::string& name,
                  int64_t missing = 0);

/// Finds the frames, in order, of the key called `id` and of the keys that hold its pose. `id` may
/// be ID@TIME if several keys have the same id: the nearest one, at most half a count or kTooNear
/// (key_file.h) away. Throws Error(kInvalidArgument, field) unless there is exactly one, and for a
/// TIME in counts that `counts` lack.
std::vector<int64_t> FindKey(const ReportKeys& keys, const std::string& id, double fps,
                             const std::string& field, const authoring::Counts& counts);

/// Whether a key only holds another one's pose.
bool HoldsAnother(const nlohmann::ordered_json& key);

/// The last key's frame, if that key only holds a pose.
std::optional<int64_t> HeldEnd(const ReportKeys& keys);

/// Marks a key as only holding the pose of this id.
void MarkHeld(const std::string& id, nlohmann::ordered_json* key);

/// How hard a key is hit; none if it does not state that.
std::optional<double> HitOf(const nlohmann::ordered_json& key);
void MarkHit(const std::optional<double>& hit, nlohmann::ordered_json* key);

/// The hands' pose at a key; none if it does not state one.
std::optional<HandPose> HandsOf(const nlohmann::ordered_json& key);
void MarkHands(const std::optional<HandPose>& hands, nlohmann::ordered_json* key);

/// Copies the marks of one key to another: whether it only holds a pose, its hit and its hands.
void CopyMarks(const nlohmann::ordered_json& from, nlohmann::ordered_json* to);

/// The hands' poses in a dance, from the keys of its report (ReadReport), in order of time.
std::vector<HandKey> HandKeys(const nlohmann::ordered_json& report);

}  // namespace choreo::cli
