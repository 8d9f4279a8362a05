#include "client/authoring/keys/key_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/key_joints.h"
#include "client/authoring/keys/key_numbers.h"
#include "client/authoring/keys/motion_input.h"
#include "client/authoring/keys/placing.h"
#include "client/authoring/keys/pose_library.h"
#include "model/core/rounded.h"
#include "model/core/text/nearest.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/resample.h"

namespace choreo::authoring {
namespace {

using client::KeyPose;
using nlohmann::json;

constexpr const char* kHold = ".hold";
constexpr size_t kMaxNamed = 8;  // keys named in a message

/// Whether `joints` gives degrees, not only names.
bool HasDegrees(const json& value) {
  return value.contains("joints") && value["joints"].is_object();
}

// Parses the pose of a key that names a pose or gives only joints.
KeyPose ParseNamed(const json& value, const std::string& field, const Skeleton& skeleton) {
  if (value.contains("pose")) {
    RefuseNumbers(value, field);
    return ReadNamedPose(value, field, skeleton);
  }
  KeyPose key;
  key.pose = RestPose(skeleton);
  return key;
}

KeyPose ParseKey(const json& value, const std::string& field, const Skeleton& skeleton,
                 const Counts& counts, size_t number) {
  CheckMembers(value, field,
               {"id", "time", "frame", "hold", "hit", "hands", "pose", "place", "facing", "joints",
                "root_position", "rotations", "smpl_poses", "smpl_trans", "poses", "trans"},
               "a key has id, time or frame, hold, hit, hands, place, facing, joints, and pose; or "
               "root_position, rotations; or smpl_poses, smpl_trans; or poses, trans");
  const bool named = value.contains("pose") || (HasDegrees(value) && !HasNumbers(value));
  KeyPose key = named ? ParseNamed(value, field, skeleton) : ReadNumbers(value, field, skeleton);
  // A pose of the library is around the origin; another one is where its numbers say.
  if (!value.contains("pose")) PlaceRoot(ReadPlacing(value, field), field + ".place", &key);
  key.id = "key" + std::to_string(number);
  if (value.contains("id")) {
    if (!value["id"].is_string() || value["id"].get<std::string>().empty()) {
      throw InvalidArgument(field + ".id", Shown(value["id"]) + " is not a name");
    }
    key.id = value["id"].get<std::string>();
  }
  if (value.contains("hit")) key.hit = JsonHit(value["hit"], field + ".hit");
  if (value.contains("hands")) key.hands = JsonHands(value["hands"], field + ".hands");
  const Moment moment = ParseMoment(value, field, counts);
  key.time_s = moment.time_s;
  key.frame = moment.frame;
  if (value.contains("joints")) ReadJoints(value["joints"], field + ".joints", skeleton, &key);
  if (named && !value.contains("pose")) LimitToNamed(value, skeleton, &key);
  return key;
}

double ParseSeconds(std::string_view text, const std::string& source) {
  if (text.ends_with('c')) {
    throw InvalidArgument(source, "\"" + std::string(text) +
                                      "\" is a count, and a motion knows no song: say seconds");
  }
  double seconds = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (code != std::errc() || end != text.data() + text.size() || !(seconds >= 0) ||
      seconds > kMaxSeconds) {
    throw InvalidArgument(source, "\"" + std::string(text) + "\" is not a time, 0 to " +
                                      InFull(kMaxSeconds) + " seconds");
  }
  return seconds;
}

std::vector<KeyPose> ReadMotionKeys(const std::string& path, std::string_view times,
                                    const std::string& source, const Skeleton& skeleton,
                                    const Counts& counts) {
  const Motion motion = ReadMotionNoting(path, skeleton);
  const double duration = Duration(motion);
  std::vector<KeyPose> keys;
  while (true) {
    const std::string_view item = times.substr(0, times.find(','));
    const std::string_view from = item.substr(0, item.find('='));
    const double at = ParseSeconds(from, source);
    if (at > duration) {
      std::ostringstream message;
      message << "second " << at << " is after the motion's end at " << duration;
      throw InvalidArgument(source, message.str());
    }
    KeyPose& key = keys.emplace_back();
    key.id = std::filesystem::path(path).stem().string() + "@" + std::string(item);
    key.pose = PoseAt(motion, at);
    // A motion's rotation vectors may contain any number of whole turns.
    MakeContinuous(key.pose, {{}, Eigen::Matrix3Xd::Zero(3, key.pose.rotations.cols())});
    key.time_s =
        from.size() == item.size()
            ? at
            : ParseTime(std::string(item.substr(from.size() + 1)), source).In(counts, source);
    if (item.size() == times.size()) return keys;
    times.remove_prefix(item.size() + 1);
  }
}

/// Keeps only the key with this id and those that hold it.
void KeepOne(const std::string& id, const std::string& file, std::vector<KeyPose>* keys,
             std::vector<std::string>* places) {
  size_t from = 0;
  std::vector<std::string> ids;
  for (; from < keys->size() && (IsHeld((*places)[from]) || (*keys)[from].id != id); ++from)
    if (!IsHeld((*places)[from])) ids.push_back((*keys)[from].id);
  if (from == keys->size()) {
    throw InvalidArgument(
        file, "has no key \"" + id + "\"; " + DidYouMean(id, ids, std::identity(), kMaxNamed));
  }
  size_t end = from + 1;
  while (end < keys->size() && IsHeld((*places)[end])) ++end;
  *keys = {keys->begin() + static_cast<std::ptrdiff_t>(from),
           keys->begin() + static_cast<std::ptrdiff_t>(end)};
  *places = {places->begin() + static_cast<std::ptrdiff_t>(from),
             places->begin() + static_cast<std::ptrdiff_t>(end)};
}

}  // namespace

std::vector<KeyPose> Holding(KeyPose* key, double seconds, const std::string& field) {
  if (!(seconds >= kMinHoldSeconds && seconds <= kMaxHoldSeconds)) {
    std::ostringstream message;
    message << seconds << " s, must be " << kMinHoldSeconds << " to " << kMaxHoldSeconds;
    throw InvalidArgument(field, message.str());
  }
  const int steps = std::max(1, static_cast<int>(std::floor(seconds / kHoldStep + 1e-9)));
  std::vector<KeyPose> holding(static_cast<size_t>(steps), *key);
  for (KeyPose& held : holding) held.hit.reset();
  for (int step = 1; step <= steps; ++step) {
    KeyPose& held = holding[static_cast<size_t>(step) - 1];
    held.time_s += seconds * step / steps;
    held.id += kHeldStep + std::to_string(step);
  }
  if (!key->hit) key->hit = kUsualHit;
  return holding;
}

std::vector<KeyPose> ParseKeyFile(std::string_view text, const std::string& name,
                                  const Skeleton& skeleton, std::vector<std::string>* places,
                                  const Counts& counts) {
  return KeysIn(ParseJson(text, name), name, skeleton, places, counts);
}

std::vector<KeyPose> KeysIn(const json& file, const std::string& name, const Skeleton& skeleton,
                            std::vector<std::string>* places, const Counts& counts) {
  const json& list = ListIn(file, name, "keyframes");
  std::vector<KeyPose> keys;
  std::vector<std::string> own_places;
  if (!places) places = &own_places;
  places->clear();
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string field = name + ":keyframes[" + std::to_string(i) + "]";
    keys.push_back(ParseKey(list[i], field, skeleton, counts, i + 1));
    if (list[i].contains("hold")) {
      if (!list[i].contains("time")) throw InvalidArgument(HoldOf(field), "goes with time");
      const double from = keys.back().time_s;
      const double seconds =
          JsonTime(list[i]["hold"], HoldOf(field)).After(from, counts, HoldOf(field)) - from;
      std::ranges::copy(Holding(&keys.back(), seconds, HoldOf(field)), std::back_inserter(keys));
    }
    places->push_back(field);
    places->resize(keys.size(), HoldOf(field));
  }
  RequireOwnIds(keys, *places);
  return keys;
}

void RequireOwnIds(const std::vector<KeyPose>& keys, const std::vector<std::string>& places) {
  std::set<std::string> ids;
  for (size_t i = 0; i < keys.size(); ++i) {
    if (IsHeld(places[i]) || ids.insert(keys[i].id).second) continue;
    throw InvalidArgument(places[i] + ".id",
                          "\"" + keys[i].id + "\" is already the id of an earlier key");
  }
}

std::string HoldOf(const std::string& place) { return place + kHold; }

bool IsHeld(const std::string& place) { return place.ends_with(kHold); }

std::string FieldOf(const std::string& place, const std::string& member) {
  if (!IsHeld(place)) return place + member;
  const bool says_when = member == ".time" || member == ".frame";
  return says_when ? place : place.substr(0, place.rfind('.')) + member;
}

std::filesystem::path FileOf(const std::string& source) {
  std::error_code error;
  if (std::filesystem::exists(source, error)) return source;
  const size_t last = source.rfind('@');
  // The id after the file's name may also contain "@".
  for (size_t end = last; end != std::string::npos && end > 0; end = source.rfind('@', end - 1)) {
    if (std::filesystem::is_regular_file(source.substr(0, end), error))
      return source.substr(0, end);
  }
  return source.substr(0, last);
}

std::vector<KeyPose> ReadKeys(const std::string& source, const Skeleton& skeleton,
                              std::vector<std::string>* places, const Counts& counts) {
  if (source.starts_with('{')) {
    const json file = ParseJson(source, "keyframes");
    return KeysIn(file, file.value("name", "keyframes"), skeleton, places, counts);
  }
  const std::string file = FileOf(source);
  const bool chooses = file.size() < source.size();
  const std::string chosen = chooses ? source.substr(file.size() + 1) : "";
  std::vector<std::string> own_places;
  if (!places) places = &own_places;
  const auto is_it = [&](const LibraryPose& pose) { return pose.id == source; };
  if (!std::filesystem::exists(file) && std::ranges::any_of(PoseLibrary(), is_it)) {
    throw InvalidArgument(source,
                          "is a pose of the library, not a file: a key file says when it comes, or "
                          "choreo edit --key sets it in a dance");
  }
  if (!IsMotionFile(file)) {
    std::vector<KeyPose> keys =
        ParseKeyFile(ReadText(file, "key file"), file, skeleton, places, counts);
    if (chooses) KeepOne(chosen, file, &keys, places);
    return keys;
  }
  if (!chooses) {
    throw InvalidArgument(
        source, "is a motion: name its poses by their seconds, as in " + source + "@1.2,3.4");
  }
  std::vector<KeyPose> keys = ReadMotionKeys(file, chosen, source, skeleton, counts);
  places->clear();
  for (size_t i = 0; i < keys.size(); ++i)
    places->push_back(source + ":keyframes[" + std::to_string(i) + "]");
  return keys;
}

}  // namespace choreo::authoring
