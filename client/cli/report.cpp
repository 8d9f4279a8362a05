#include "client/cli/report.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

namespace choreo::cli {
namespace {

template <typename... Values>
std::string Format(const char* format, Values... values) {
  std::string text(static_cast<size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

}  // namespace

std::string ReportJson(const client::Header& header, const client::Report& report) {
  nlohmann::ordered_json json;
  json["frames"] = report.frames;
  json["fps"] = header.model_fps;
  json["seed"] = header.seed;
  json["fingerprint"] = header.fingerprint;
  json["keyframes"] = nlohmann::ordered_json::array();
  for (const client::KeyReached& key : report.keys) {
    json["keyframes"].push_back(KeyJson(key));
  }
  json["log_likelihood"] = report.log_likelihood;
  json["beat_hit_rate"] = nullptr;
  if (report.beat_hit_rate) json["beat_hit_rate"] = *report.beat_hit_rate;
  json["skate_ratio"] = report.skate_ratio;
  json["first_frame_latency_s"] = report.first_frame_latency_s;
  json["real_time_factor"] = report.real_time_factor;
  return json.dump(2) + "\n";
}

nlohmann::ordered_json KeyJson(const client::KeyReached& key) {
  return {{"id", key.id},
          {"frame", key.frame},
          {"raw_error_m", key.raw_error_m},
          {"final_error_m", key.final_error_m},
          {"final_error_deg", key.final_error_deg}};
}

nlohmann::ordered_json ReadReport(const std::filesystem::path& path) {
  std::ifstream file(path);
  auto report = nlohmann::ordered_json::parse(file, nullptr, false);
  if (!report.is_object() || !report.contains("keyframes") || !report["keyframes"].is_array() ||
      !report.contains("fps") || !report["fps"].is_number() || !(report["fps"] > 0)) {
    throw InvalidArgument(path.string(), "is not the report of a dance");
  }
  for (size_t i = 0; i < report["keyframes"].size(); ++i) {
    const auto& key = report["keyframes"][i];
    if (!key.is_object() || !key.contains("frame") || !key["frame"].is_number_unsigned() ||
        !key.contains("id") || !key["id"].is_string()) {
      throw InvalidArgument(path.string() + ":keyframes[" + std::to_string(i) + "]",
                            "has no id, or no frame that is a whole number >= 0");
    }
  }
  return report;
}

std::string ReportText(const client::Header& header, const client::Report& report) {
  double raw = 0;
  double final_m = 0;
  double final_deg = 0;
  for (const client::KeyReached& key : report.keys) {
    raw += key.raw_error_m / static_cast<double>(report.keys.size());
    final_m = std::max(final_m, key.final_error_m);
    final_deg = std::max(final_deg, key.final_error_deg);
  }
  std::string text = Format("%lld frames (%.1f s) by model \"%s\", seed %llu\n",
                            static_cast<long long>(report.frames),
                            static_cast<double>(report.frames) / header.model_fps,
                            header.model.c_str(), static_cast<unsigned long long>(header.seed));
  if (!report.keys.empty()) {
    text += Format(
        "%zu key poses, each hit within %.3f mm and %.3f degrees; the model alone came within %.1f "
        "cm on average\n",
        report.keys.size(), 1000 * final_m, final_deg, 100 * raw);
  }
  if (report.beat_hit_rate) text += Format("beat hit rate %.0f %%, ", 100 * *report.beat_hit_rate);
  text += Format("skating in %.1f %% of the steps\n", 100 * report.skate_ratio);
  text += Format("first frame after %.0f ms, %.1f times real time\n",
                 1000 * report.first_frame_latency_s, report.real_time_factor);
  return text;
}

void WriteText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text << std::flush;
  if (!file) throw Error(ErrorCode::kInternal, path.string(), "cannot be written");
}

}  // namespace choreo::cli
