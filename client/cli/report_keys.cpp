#include "client/cli/report_keys.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "client/authoring/key_file.h"
#include "model/core/error.h"
#include "model/core/nearest.h"
#include "model/core/rounded.h"

namespace choreo::cli {
namespace {

constexpr const char* kHolds = "holds";
constexpr const char* kHit = "hit";
constexpr const char* kHands = "hands";

std::string IdOf(const nlohmann::ordered_json& key) { return key["id"].get<std::string>(); }

/// Finds the key that ID@TIME means; the end if there is none.
ReportKeys::const_iterator Nearest(const ReportKeys& keys, const std::string& id, double fps,
                                   const std::string& field, const authoring::Counts& counts) {
  const size_t at = id.rfind('@');
  const auto is_meant = [&](const auto& key) {
    return !HoldsAnother(key.second) && IdOf(key.second) == id.substr(0, at);
  };
  if (at == std::string::npos || std::ranges::none_of(keys, is_meant)) return keys.end();
  const authoring::WrittenTime time = authoring::ParseTime(id.substr(at + 1), field);
  const double second = time.In(counts, field);
  double near = authoring::kTooNear;
  if (time.counts) near = authoring::WrittenTime{0.5, true}.After(second, counts, field) - second;
  auto nearest = keys.end();
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    const double off = std::abs(static_cast<double>(key->first) / fps - second);
    if (!is_meant(*key) || off > near) continue;
    near = off;
    nearest = key;
  }
  return nearest;
}

/// Lists the keys that ID or ID@TIME may mean or, if there are none, all keys.
template <typename Second>
std::string DescribeKnown(const ReportKeys& keys, const std::string& id,
                          const std::vector<std::string>& known, const Second& second) {
  const std::string name = id.substr(0, id.rfind('@'));
  std::string seconds;
  for (const auto& [frame, key] : keys) {
    if (!HoldsAnother(key) && IdOf(key) == name)
      seconds += (seconds.empty() ? "" : ", ") + second(frame);
  }
  if (!seconds.empty()) return "it has \"" + name + "\" at " + seconds + " s";
  return DidYouMean(name, known);
}

}  // namespace

bool HoldsAnother(const nlohmann::ordered_json& key) {
  return key.contains(kHolds) && key[kHolds].is_string();
}

ReportKeys KeysOf(const nlohmann::ordered_json& report, int64_t frames, const std::string& name,
                  int64_t missing) {
  ReportKeys keys;
  for (const auto& key : report["keyframes"]) {
    const auto frame = key["frame"].get<int64_t>();
    if (frame - missing >= frames) {
      throw InvalidArgument(name + ":keyframes",
                            IdOf(key) + " stands at frame " + std::to_string(frame) +
                                ", but the dance has " + std::to_string(frames) +
                                ": it is the report of another one");
    }
    const int64_t known = std::min(frame, frames - 1);
    keys[known] = key;
    keys[known]["frame"] = known;
  }
  return keys;
}

std::vector<int64_t> FindKey(const ReportKeys& keys, const std::string& id, double fps,
                             const std::string& field, const authoring::Counts& counts) {
  const auto second = [&](int64_t frame) { return Rounded(static_cast<double>(frame) / fps); };
  std::string seconds;
  std::vector<std::string> known;
  std::vector<ReportKeys::const_iterator> found;
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    if (HoldsAnother(key->second)) continue;
    const std::string name = IdOf(key->second);
    known.push_back(name);
    const bool is_one = name + '@' + second(key->first) == id;
    if (name != id && !is_one) continue;
    if (is_one) found.clear();
    found.push_back(key);
    seconds += (seconds.empty() ? "" : ", ") + second(key->first);
    if (is_one) break;
  }
  if (found.empty()) {
    if (const auto nearest = Nearest(keys, id, fps, field, counts); nearest != keys.end())
      found.push_back(nearest);
  }
  if (found.empty()) {
    throw InvalidArgument(field, "the report has no key \"" + id + "\"; " +
                                     DescribeKnown(keys, id, known, second) +
                                     " (after an edit, --new-report lists its keys)");
  }
  if (found.size() > 1) {
    throw InvalidArgument(field, "the report has keys \"" + id + "\" at " + seconds +
                                     " s; say which, as in " + id + '@' +
                                     second(found.front()->first));
  }
  std::vector<int64_t> frames;
  auto key = found.front();
  do {
    frames.push_back(key->first);
  } while (++key != keys.end() && HoldsAnother(key->second));
  return frames;
}

std::optional<int64_t> HeldEnd(const ReportKeys& keys) {
  if (keys.empty() || !HoldsAnother(keys.rbegin()->second)) return std::nullopt;
  return keys.rbegin()->first;
}

std::optional<double> HitOf(const nlohmann::ordered_json& key) {
  if (!key.contains(kHit)) return std::nullopt;
  return key[kHit].get<double>();
}

void MarkHit(const std::optional<double>& hit, nlohmann::ordered_json* key) {
  if (hit) (*key)[kHit] = *hit;
}

std::optional<HandPose> HandsOf(const nlohmann::ordered_json& key) {
  if (!key.contains(kHands)) return std::nullopt;
  return FindHandPose(key[kHands].get<std::string>());
}

void MarkHands(const std::optional<HandPose>& hands, nlohmann::ordered_json* key) {
  if (hands) (*key)[kHands] = kHandPoseNames[static_cast<size_t>(*hands)];
}

std::vector<HandKey> HandKeys(const nlohmann::ordered_json& report) {
  std::vector<HandKey> keys;
  for (const auto& key : report["keyframes"]) {
    if (const auto hands = HandsOf(key))
      keys.push_back({key["frame"].get<double>() / report["fps"].get<double>(), *hands});
  }
  std::ranges::stable_sort(keys, {}, &HandKey::time_s);
  return keys;
}

void CopyMarks(const nlohmann::ordered_json& from, nlohmann::ordered_json* to) {
  for (const char* mark : {kHolds, kHit, kHands})
    if (from.contains(mark)) (*to)[mark] = from[mark];
}

void MarkHeld(const std::string& id, nlohmann::ordered_json* key) { (*key)[kHolds] = id; }

}  // namespace choreo::cli
