#include "client/cli/report.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "client/authoring/json_fields.h"
#include "client/cli/report_keys.h"
#include "model/core/json_limits.h"

namespace choreo::cli {
namespace {

constexpr const char* kSketch = "motion_sketch";

template <typename... Values>
std::string Format(const char* format, Values... values) {
  std::string text(static_cast<size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

/// Describes the errors at keys: in the file and, for keys between its frames, in the dance.
std::string KeysText(const WrittenDance& dance) {
  struct Worst {
    size_t keys = 0;
    double distance_m = 0;
    double angle_deg = 0;
    void Add(const WrittenKey& key, double distance, double angle) {
      if (key.holds.empty()) ++keys;
      distance_m = std::max(distance_m, distance);
      angle_deg = std::max(angle_deg, angle);
    }
    std::string Text() const {
      return Format("%.3f mm and %.3f degrees", 1000 * distance_m, angle_deg);
    }
  };
  Worst in_file, near, between;
  double raw = 0;
  const client::KeyReached* furthest = nullptr;
  const auto keys =
      std::ranges::count_if(dance.keys, [](const WrittenKey& key) { return key.holds.empty(); });
  for (const WrittenKey& key : dance.keys) {
    if (key.on_frame) {
      in_file.Add(key, key.error.position_m, key.error.angle_deg);
    } else {
      near.Add(key, key.error.position_m, key.error.angle_deg);
      between.Add(key, key.reached.final_error_m, key.reached.final_error_deg);
    }
    // A pose that is already held needs almost no correction.
    if (key.holds.empty()) raw += key.reached.raw_error_m / static_cast<double>(keys);
    if (!furthest || key.reached.correction_m > furthest->correction_m) furthest = &key.reached;
  }
  std::string text = Format("%zd key pose%s", keys, keys == 1 ? "" : "s");
  if (in_file.keys > 0) {
    text += between.keys > 0 ? Format(": %zu", in_file.keys) : std::string(", each");
    text += " hit within " + in_file.Text() + ", measured in the file";
  }
  if (between.keys > 0) {
    text += Format(
        "%s %zu between the frames of a file at %g fps: hit within %s at the model's %g, the "
        "file's nearest frames are up to %.1f mm off",
        in_file.keys > 0 ? ";" : ":", between.keys, dance.fps, between.Text().c_str(),
        dance.header.model_fps, 1000 * near.distance_m);
  }
  return text +
         Format(
             "\non the way to a key the model's frames are bent towards it: a joint by %.1f cm at "
             "most, to \"%s\" at %s; %.1f cm on average were left to the keys\n",
             100 * furthest->correction_m, furthest->id.c_str(),
             ToldTimes{dance.header.model_fps}.Of(furthest->frame).c_str(), 100 * raw);
}

}  // namespace

std::string ReportJson(const WrittenDance& dance) {
  const auto or_null = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  const client::Report& report = dance.report;
  nlohmann::ordered_json json;
  json["frames"] = report.frames;
  json["fps"] = dance.header.model_fps;
  json["output_frames"] = dance.frames;
  json["output_fps"] = dance.fps;
  json["seed"] = dance.header.seed;
  json["fingerprint"] = dance.header.fingerprint;
  WriteSketch(dance.sketch, &json);
  dance.asked.WriteTo(&json);
  json["keyframes"] = nlohmann::ordered_json::array();
  for (const WrittenKey& key : dance.keys) {
    nlohmann::ordered_json& written = json["keyframes"].emplace_back(KeyJson(key.reached));
    if (!key.holds.empty()) MarkHeld(key.holds, &written);
    MarkHit(key.hit, &written);
    MarkHands(key.hands, &written);
    written["output_frame"] = key.frame;
    written["on_output_frame"] = key.on_frame;
    written["output_error_m"] = key.error.position_m;
    written["output_error_deg"] = key.error.angle_deg;
  }
  json["warnings"] = WarningsJson(dance.warnings);
  if (!dance.is_complete) return json.dump(2) + "\n";
  json["measured_from"] = report.measured_from;
  json["log_likelihood"] = or_null(report.log_likelihood);
  json["beat_hit_rate"] = or_null(report.beat_hit_rate);
  json["beat_coverage"] = or_null(report.beat_coverage);
  json["beat_hit_chance"] = or_null(dance.beat_hit_chance);
  json["skate_ratio"] = report.skate_ratio;
  json["support"] = or_null(report.support);
  json["max_key_acceleration"] = report.max_key_acceleration;
  json["p95_acceleration"] = report.p95_acceleration;
  if (!report.part_speeds.empty()) {
    auto& speeds = json["part_speeds"] = nlohmann::ordered_json::object();
    for (size_t part = 0; part < kBodyParts; ++part) {
      const auto& [asked, danced] = report.part_speeds[part];
      speeds[std::string(kBodyPartNames[part])] = {{"asked", asked}, {"danced", danced}};
    }
  }
  json["first_frame_latency_s"] = report.timing.first_frame_latency_s;
  json["real_time_factor"] = report.timing.real_time_factor;
  return json.dump(2) + "\n";
}

nlohmann::ordered_json KeyJson(const client::KeyReached& key) {
  return {{"id", key.id},
          {"frame", key.frame},
          {"raw_error_m", key.raw_error_m},
          {"correction_m", key.correction_m},
          {"final_error_m", key.final_error_m},
          {"final_error_deg", key.final_error_deg},
          {"max_acceleration", key.max_acceleration}};
}

nlohmann::ordered_json WarningsJson(std::vector<client::Warning> warnings) {
  std::ranges::stable_sort(warnings, {}, &client::Warning::frame);
  auto json = nlohmann::ordered_json::array();
  for (const client::Warning& warning : warnings)
    json.push_back({{"frame", warning.frame}, {"message", warning.message}});
  return json;
}

std::string Told(const client::Warning& warning, const ToldTimes& times) {
  return "warning: " + times.Of(warning.frame) + " (frame " + std::to_string(warning.frame) +
         "): " + warning.message;
}

void ShowWarnings(const std::vector<client::Warning>& warnings, const ToldTimes& times) {
  for (const client::Warning& warning : warnings) std::cerr << Told(warning, times) << '\n';
}

void CheckSketch(const std::filesystem::path& path, const nlohmann::ordered_json& report,
                 const Motion& file) {
  const MotionSketch known = ReadSketch(report, path);
  if (known.empty() || !report.contains("frames") || !authoring::IsFrameNumber(report["frames"]))
    return;
  const size_t unlike = CountUnlike(
      known, SketchOf(file, report["frames"].get<int64_t>(), report["fps"].get<double>()));
  if (unlike == 0) return;
  const std::string moments =
      std::to_string(unlike) + " of " + std::to_string(known.size()) + " moments";
  if (2 * unlike > known.size()) {
    throw InvalidArgument(path.string(),
                          "is another dance's report: this one looks otherwise at " + moments);
  }
  std::cerr << "note: the dance looks otherwise than " << path.string() << " says at " << moments
            << ": it was edited since, and what those edits set is not known; their --new-report "
               "tells\n";
}

nlohmann::ordered_json ReadReport(const std::filesystem::path& path) {
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  CheckJsonDepth(text, path.string());
  auto report = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!report.is_object() || !report.contains("keyframes") || !report["keyframes"].is_array() ||
      !report.contains("fps") || !report["fps"].is_number() || !(report["fps"] > 0)) {
    throw InvalidArgument(path.string(), "is not the report of a dance");
  }
  for (size_t i = 0; i < report["keyframes"].size(); ++i) {
    const auto& key = report["keyframes"][i];
    if (!key.is_object() || !key.contains("frame") || !authoring::IsFrameNumber(key["frame"]) ||
        !key.contains("id") || !key["id"].is_string()) {
      throw InvalidArgument(path.string() + ":keyframes[" + std::to_string(i) + "]",
                            "has no id, or no frame that is a whole number from 0 to " +
                                std::to_string(authoring::kMaxFrameNumber));
    }
    const std::string field = path.string() + ":keyframes[" + std::to_string(i) + "]";
    if (key.contains("hit")) authoring::JsonHit(key["hit"], field + ".hit");
    if (key.contains("hands")) authoring::JsonHands(key["hands"], field + ".hands");
  }
  return report;
}

void WriteSketch(const MotionSketch& sketch, nlohmann::ordered_json* report) {
  (*report)[kSketch] = sketch;
}

MotionSketch ReadSketch(const nlohmann::ordered_json& report, const std::filesystem::path& path) {
  if (!report.contains(kSketch)) return {};
  const auto is_number = [](const auto& value) { return value.is_number(); };
  if (!report[kSketch].is_array() || !std::ranges::all_of(report[kSketch], is_number))
    throw InvalidArgument(path.string() + ":" + kSketch, "is not a list of numbers");
  return report[kSketch].get<MotionSketch>();
}

std::vector<client::Warning> ReadWarnings(const nlohmann::ordered_json& report,
                                          const std::filesystem::path& path) {
  std::vector<client::Warning> warnings;
  if (!report.contains("warnings")) return warnings;
  if (!report["warnings"].is_array())
    throw InvalidArgument(path.string() + ":warnings", "is not a list");
  for (const auto& warning : report["warnings"]) {
    if (!warning.is_object() || !warning.contains("frame") ||
        !authoring::IsFrameNumber(warning["frame"]) || !warning.contains("message") ||
        !warning["message"].is_string()) {
      throw InvalidArgument(path.string() + ":warnings[" + std::to_string(warnings.size()) + "]",
                            "has no message, or no frame that is a whole number from 0 to " +
                                std::to_string(authoring::kMaxFrameNumber));
    }
    warnings.push_back({.frame = warning["frame"], .message = warning["message"]});
  }
  return warnings;
}

std::string ReportText(const WrittenDance& dance) {
  const client::Report& report = dance.report;
  std::string text = Format(
      "%lld frames (%.1f s) by model \"%s\", seed %llu\n", static_cast<long long>(report.frames),
      static_cast<double>(report.frames) / dance.header.model_fps, dance.header.model.c_str(),
      static_cast<unsigned long long>(dance.header.seed));
  if (!dance.keys.empty()) text += KeysText(dance);
  if (report.measured_from > dance.header.first_frame) {
    text += Format("since frame %lld, where another server took over: ",
                   static_cast<long long>(report.measured_from));
  }
  if (report.beat_hit_rate) {
    text += Format("beat hit rate %.0f %%", 100 * *report.beat_hit_rate);
    if (dance.beat_hit_chance) text += Format(" (chance: %.0f %%)", 100 * *dance.beat_hit_chance);
    text += ", ";
  }
  text += Format("skating in %.1f %% of the steps", 100 * report.skate_ratio);
  if (report.support)
    text += Format(", balanced over her feet in %.0f %% of the frames", 100 * *report.support);
  text += '\n';
  if (!report.part_speeds.empty()) {
    text += "speeds danced (and asked), cm a frame:";
    for (size_t part = 0; part < kBodyParts; ++part) {
      const auto& [asked, danced] = report.part_speeds[part];
      text += Format("%s %s %.2f (%.2f)", part > 0 ? "," : "",
                     std::string(kBodyPartNames[part]).c_str(), 100 * danced, 100 * asked);
    }
    text += '\n';
  }
  text += Format("first frame after %.0f ms, %.1f times real time\n",
                 1000 * report.timing.first_frame_latency_s, report.timing.real_time_factor);
  return text;
}

}  // namespace choreo::cli
