#include "client/cli/report/report_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/key_file.h"
#include "client/cli/report/report_controls.h"
#include "client/cli/report/time_format.h"
#include "model/core/error.h"
#include "model/core/files/json_limits.h"
#include "model/core/rounded.h"
#include "model/core/text/nearest.h"

namespace choreo::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kSketch = "motion_sketch";

constexpr std::pair<const char*, double client::KeyReached::*> kFigures[] = {
    {"raw_error_m", &client::KeyReached::raw_error_m},
    {"correction_m", &client::KeyReached::correction_m},
    {"final_error_m", &client::KeyReached::final_error_m},
    {"final_error_deg", &client::KeyReached::final_error_deg},
    {"max_acceleration", &client::KeyReached::max_acceleration}};

template <typename Report, typename Settings, typename Visit>
void VisitMembers(Report& report, Settings& settings, const Visit& visit) {
  visit(report, "model", settings.model);
  visit(report, "seed", settings.seed);
  visit(report, "take_seed", settings.take_seed);
  DanceManner::VisitSettings(
      [&](const SettingRow& row, auto& setting) { visit(report, row.name, setting); }, settings);
  visit(report, "song", settings.song);
  visit(report, "song_start", settings.song_start_s);
  visit(report, "music_beats", settings.beats);
  visit(report, "music_downbeats", settings.downbeats);
}

struct MemberWriter {
  template <typename Value>
  void operator()(ordered_json& report, const char* member, const Value& value) const {
    if (value != Value()) report[member] = value;
  }
  template <typename Value>
  void operator()(ordered_json& report, const char* member,
                  const std::optional<Value>& value) const {
    if (value) report[member] = *value;
  }
};

/// Reads the members that there are. `place` precedes a member's name in errors.
struct MemberReader {
  std::string place;

  template <typename Value>
  bool operator()(const ordered_json& report, const char* member, Value& value) const {
    if (!report.contains(member) || report[member].is_null()) return false;
    try {
      if (!IsWhole<Value>(report[member])) throw std::out_of_range(member);
      report[member].get_to(value);
      return true;
    } catch (const std::exception&) {
      throw InvalidArgument(place + member,
                            authoring::Shown(report[member]) + " is not valid in a report");
    }
  }
  template <typename Value>
  bool operator()(const ordered_json& report, const char* member,
                  std::optional<Value>& value) const {
    Value read = {};
    if (!(*this)(report, member, read)) return false;
    value = std::move(read);
    return true;
  }

 private:
  /// Whether an integer can hold the number; the library would round it, or count it down from
  /// 2^64.
  template <typename Value>
  static bool IsWhole([[maybe_unused]] const ordered_json& number) {
    if constexpr (std::is_same_v<Value, uint64_t>) return number.is_number_unsigned();
    if constexpr (std::is_same_v<Value, int64_t>) return number.is_number_integer();
    return true;
  }
};

int64_t FrameIn(const ordered_json& part, const char* text, const std::string& field) {
  if (part.is_object() && part.contains("frame") && authoring::IsFrameNumber(part["frame"]) &&
      part.contains(text) && part[text].is_string()) {
    return part["frame"].get<int64_t>();
  }
  throw InvalidArgument(field, std::string("has no ") + text +
                                   ", or no frame that is a whole number from 0 to " +
                                   std::to_string(authoring::kMaxFrameNumber));
}

/// To 4 decimals, without "-0": time and count are there for people, the frame for programs.
double Short(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

ordered_json KeyJson(const ReportKey& key, const TimeFormat& times) {
  ordered_json written = {
      {"id", key.id}, {"frame", key.frame}, {"time", Short(times.Second(key.frame))}};
  if (const auto count = times.Count(key.frame)) written["count"] = Short(*count);
  for (const auto& [member, figure] : kFigures)
    if (!std::isnan(key.*figure)) written[member] = key.*figure;
  if (!key.holds.empty()) written["holds"] = key.holds;
  if (key.hit) written["hit"] = *key.hit;
  if (key.hands) written["hands"] = kHandPoseNames[static_cast<size_t>(*key.hands)];
  if (key.in_file) {
    written["output_frame"] = key.in_file->frame;
    written["on_output_frame"] = key.in_file->on_frame;
    written["output_error_m"] = key.in_file->error.position_m;
    written["output_error_deg"] = key.in_file->error.angle_deg;
  }
  return written;
}

ReportKey ReadKey(const ordered_json& value, const std::string& field) {
  ReportKey key;
  key.frame = FrameIn(value, "id", field);
  key.id = value["id"].get<std::string>();
  const MemberReader read{field + "."};
  for (const auto& [member, figure] : kFigures) {
    key.*figure = std::numeric_limits<double>::quiet_NaN();
    read(value, member, key.*figure);
  }
  read(value, "holds", key.holds);
  if (value.contains("hit")) key.hit = authoring::JsonHit(value["hit"], field + ".hit");
  if (value.contains("hands")) key.hands = authoring::JsonHands(value["hands"], field + ".hands");
  ReportKey::InFile in_file;
  if (read(value, "output_frame", in_file.frame) &&
      read(value, "on_output_frame", in_file.on_frame) &&
      read(value, "output_error_m", in_file.error.position_m) &&
      read(value, "output_error_deg", in_file.error.angle_deg)) {
    key.in_file = in_file;
  }
  return key;
}

/// Finds the key that ID@TIME means; the end if there is none.
ReportKeys::const_iterator NearestKey(const ReportKeys& keys, const std::string& id, double fps,
                                      const std::string& field, const authoring::Counts& counts) {
  const size_t at = id.rfind('@');
  const auto is_meant = [&](const auto& key) {
    return key.second.holds.empty() && key.second.id == id.substr(0, at);
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
    if (key.holds.empty() && key.id == name)
      seconds += (seconds.empty() ? "" : ", ") + second(frame);
  }
  if (!seconds.empty()) return "it has \"" + name + "\" at " + seconds + " s";
  return DidYouMean(name, known);
}

}  // namespace

void ReportFile::WriteTo(ordered_json* json) const {
  if (frames) (*json)["frames"] = *frames;
  (*json)["fps"] = fps;
  (*json)[kSketch] = sketch;
  VisitMembers(*json, settings, MemberWriter());
  WriteControls(settings.controls, json);
  ordered_json& written = (*json)["keyframes"] = ordered_json::array();
  for (const auto& [frame, key] : keys) written.push_back(KeyJson(key, {fps, counts}));
  ordered_json& warned = (*json)["warnings"] = ordered_json::array();
  std::vector<client::Warning> sorted = warnings;
  std::ranges::stable_sort(sorted, {}, &client::Warning::frame);
  for (const client::Warning& warning : sorted)
    warned.push_back({{"frame", warning.frame}, {"message", warning.message}});
  (*json)["faults"] = FaultsJson(faults, {fps, counts});
}

ReportFile ReadReport(const std::filesystem::path& path) {
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string name = path.string();
  CheckJsonDepth(text, name);
  const auto value = ordered_json::parse(text, nullptr, false);
  if (!value.is_object() || !value.contains("keyframes") || !value["keyframes"].is_array() ||
      !value.contains("fps") || !value["fps"].is_number() || !(value["fps"] > 0)) {
    throw InvalidArgument(name, "is not the report of a dance");
  }
  const auto at = [&](const char* list, size_t i) {
    return name + ":" + list + "[" + std::to_string(i) + "]";
  };
  ReportFile report;
  report.fps = value["fps"];
  const MemberReader read{name + ":"};
  read(value, "frames", report.frames);
  if (value.contains(kSketch)) {
    const auto is_number = [](const auto& number) { return number.is_number(); };
    if (!value[kSketch].is_array() || !std::ranges::all_of(value[kSketch], is_number))
      throw InvalidArgument(name + ":" + kSketch, "is not a list of numbers");
    report.sketch = value[kSketch].get<MotionSketch>();
  }
  VisitMembers(value, report.settings, read);
  report.settings.Check(read.place);
  report.settings.controls = ReadControls(value, name);
  for (size_t i = 0; i < value["keyframes"].size(); ++i) {
    ReportKey key = ReadKey(value["keyframes"][i], at("keyframes", i));
    const auto [other, is_new] = report.keys.emplace(key.frame, std::move(key));
    if (!is_new) {
      throw InvalidArgument(
          at("keyframes", i) + ".frame",
          std::to_string(other->first) + " is that of \"" + other->second.id + "\", too");
    }
  }
  if (!value.contains("warnings")) return report;
  if (!value["warnings"].is_array()) throw InvalidArgument(name + ":warnings", "is not a list");
  for (const auto& warning : value["warnings"]) {
    const int64_t frame = FrameIn(warning, "message", at("warnings", report.warnings.size()));
    report.warnings.push_back({.frame = frame, .message = warning["message"]});
  }
  return report;
}

void CheckSketch(const std::filesystem::path& path, const ReportFile& report, const Motion& file) {
  const MotionSketch& known = report.sketch;
  if (known.empty() || !report.frames) return;
  const size_t unlike = CountUnlike(known, SketchOf(file, *report.frames, report.fps));
  if (unlike == 0) return;
  const std::string moments =
      std::to_string(unlike) + " of " + std::to_string(known.size()) + " moments";
  if (2 * unlike > known.size()) {
    throw InvalidArgument(path.string(),
                          "is the report of another dance, which differs at " + moments);
  }
  std::cerr << "note: the dance differs from " << path.string() << " says at " << moments
            << ": it has been edited since; the --new-report of the last edit names all keys\n";
}

ReportKeys Moved(ReportKeys keys, int64_t frames, std::optional<int64_t> in_file) {
  ReportKeys moved;
  for (auto& [frame, key] : keys) {
    key.frame += frames;
    if (!in_file)
      key.in_file.reset();
    else if (key.in_file)
      key.in_file->frame += *in_file;
    moved.emplace(key.frame, std::move(key));
  }
  return moved;
}

std::vector<int64_t> FindKey(const ReportKeys& keys, const std::string& id, double fps,
                             const std::string& field, const authoring::Counts& counts) {
  const auto second = [&](int64_t frame) { return Rounded(static_cast<double>(frame) / fps); };
  std::string seconds;
  std::vector<std::string> known;
  std::vector<ReportKeys::const_iterator> found;
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    if (!key->second.holds.empty()) continue;
    const std::string& name = key->second.id;
    known.push_back(name);
    const bool is_one = name + '@' + second(key->first) == id;
    if (name != id && !is_one) continue;
    if (is_one) found.clear();
    found.push_back(key);
    seconds += (seconds.empty() ? "" : ", ") + second(key->first);
    if (is_one) break;
  }
  if (found.empty()) {
    if (const auto nearest = NearestKey(keys, id, fps, field, counts); nearest != keys.end())
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
  } while (++key != keys.end() && !key->second.holds.empty());
  return frames;
}

std::optional<int64_t> HeldEnd(const ReportKeys& keys) {
  if (keys.empty() || keys.rbegin()->second.holds.empty()) return std::nullopt;
  return keys.rbegin()->first;
}

std::vector<HandKey> HandKeys(const ReportFile& report) {
  std::vector<HandKey> hands;
  for (const auto& [frame, key] : report.keys)
    if (key.hands) hands.push_back({static_cast<double>(frame) / report.fps, *key.hands});
  return hands;
}

}  // namespace choreo::cli
