#include "client/cli/report/report.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

#include "client/authoring/notes/notes.h"
#include "model/core/joined.h"
#include "model/core/text/counted.h"

namespace choreo::cli {
namespace {

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
    void Add(const ReportKey& key, double distance, double angle) {
      if (key.holds.empty()) ++keys;
      distance_m = std::max(distance_m, distance);
      angle_deg = std::max(angle_deg, angle);
    }
    std::string Text() const {
      return Format("%.3f mm and %.3f degrees", 1000 * distance_m, angle_deg);
    }
  };
  Worst in_file, near, between;
  const ReportKey* furthest = nullptr;
  const auto keys =
      std::ranges::count_if(dance.keys, [](const auto& key) { return key.second.holds.empty(); });
  for (const auto& [frame, key] : dance.keys) {
    const auto& [position_m, angle_deg] = key.in_file->error;
    if (key.in_file->on_frame) {
      in_file.Add(key, position_m, angle_deg);
    } else {
      near.Add(key, position_m, angle_deg);
      between.Add(key, key.final_error_m, key.final_error_deg);
    }
    if (!furthest || key.correction_m > furthest->correction_m) furthest = &key;
  }
  std::string text = Counted(keys, "key pose");
  if (in_file.keys > 0) {
    text += between.keys > 0 ? Format(": %zu", in_file.keys) : std::string(", each");
    text += " hit within " + in_file.Text() + ", measured in the file";
  }
  if (between.keys > 0) {
    text += Format(
        "%s %zu between the frames of a file at %g fps: hit within %s at the model's %g, the "
        "file's nearest frames are up to %.1f mm off",
        in_file.keys > 0 ? ";" : ":", between.keys, dance.file_fps, between.Text().c_str(),
        dance.header.model_fps, 1000 * near.distance_m);
  }
  return text +
         Format("\non the way to \"%s\" (%s) a joint is pulled %.1f cm off its free motion%s\n",
                furthest->id.c_str(),
                TimeFormat{dance.header.model_fps}.Of(furthest->frame).c_str(),
                100 * furthest->correction_m, keys == 1 ? "" : ", the most of all keys");
}

/// Tells where keys fall, if they are few; the report tells all.
std::string KeyTimesText(const WrittenDance& dance) {
  constexpr std::ptrdiff_t kMaxTold = 8;
  const TimeFormat times{dance.fps, dance.counts};
  std::vector<std::string> told;
  for (const auto& [frame, key] : dance.keys)
    if (key.holds.empty()) told.push_back(key.id + " at " + times.Of(frame));
  if (told.empty()) return "";
  if (std::ssize(told) <= kMaxTold) return "keys: " + Joined(told, std::identity(), "; ") + "\n";
  return "keys: " + told.front() + " to " + told.back() + "; --report lists them\n";
}

}  // namespace

std::string ReportJson(const WrittenDance& dance) {
  const auto or_null = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  const client::Report& report = dance.figures;
  nlohmann::ordered_json json;
  json["output_frames"] = dance.file_frames;
  json["output_fps"] = dance.file_fps;
  json["seed"] = dance.header.seed;
  json["fingerprint"] = dance.header.fingerprint;
  dance.WriteTo(&json);
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

std::string Describe(const client::Warning& warning, const TimeFormat& times) {
  return "warning: " + times.Of(warning.frame) + " (frame " + std::to_string(warning.frame) +
         "): " + warning.message;
}

void ShowWarnings(const std::vector<client::Warning>& warnings, const TimeFormat& times) {
  for (const client::Warning& warning : warnings) authoring::Note(Describe(warning, times));
}

std::string ReportText(const WrittenDance& dance) {
  const client::Report& report = dance.figures;
  std::string text = Format(
      "%lld frames (%.1f s) by model \"%s\", seed %llu\n", static_cast<long long>(report.frames),
      static_cast<double>(report.frames) / dance.header.model_fps, dance.header.model.c_str(),
      static_cast<unsigned long long>(dance.header.seed));
  if (!dance.keys.empty()) text += KeysText(dance) + KeyTimesText(dance);
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
    text += "speeds danced (and requested), cm a frame:";
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
