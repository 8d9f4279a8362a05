#include "proto/wire/field_path.h"

#include <array>
#include <utility>

#include "model/messages/dance_manner.h"

namespace choreo::wire {
namespace {

// What the model's errors call a value, and its path in StreamDanceRequest or
// GenerateTransitionRequest. The first row that begins a field applies, so longer rows come first.
// Names that are the path already ("target_id", "controls") need no row, nor do the settings and
// what is known of the music, which are in the config.
constexpr std::array<std::pair<std::string_view, std::string_view>, 24> kPaths = {{
    // DanceConfig and GroupRequest
    {"audio", "config.audio_format"},
    {"before", "config.history"},
    {"continuation", "config.continuation"},
    {"end_frame", "config.frames"},
    {"first_frame", "config.history.first_frame"},
    {"generate_until", "config.generate_until"},
    {"history", "config.history.poses"},
    {"hit", "target_hit"},
    {"output_fps", "config.frame_rate"},
    {"samples", "audio.data"},
    {"target.mask", "target_mask"},
    // DanceStream
    {"beats", "music_beats.times"},
    {"confidence", "music_beats.confidence"},
    {"downbeats", "music_beats.downbeats"},
    {"first_sample", "audio.first_sample"},
    {"keys_complete", "keyframes_complete"},
    {"passages", "music_passages.passages"},
    {"push_audio", "audio"},
    {"removed_key", "remove_keyframe"},
    {"until", "generate_until.frame"},
    // Key and KeyMoment
    {"key.at_frame", "keyframe.frame"},
    {"key.at_time", "keyframe.time"},
    {"key.after_previous", "keyframe.interval_after_previous"},
    {"key", "keyframe"},
}};

// What the API calls what a caller of the model can do.
constexpr std::array<std::pair<Remedy, std::string_view>, 3> kRemedies = {{
    {Remedy::kGrantFrames, "config.generate_until"},
    {Remedy::kSetEnd, "config.frames"},
    {Remedy::kAllowInexact, "config.allow_inexact_resume"},
}};

}  // namespace

std::string PathOf(std::string_view field) {
  std::string path(field);
  const auto is_in = [field](std::string_view own) {
    return field.starts_with(own) &&
           (field.size() == own.size() || field[own.size()] == '.' || field[own.size()] == '[');
  };
  const auto add_config = [&](std::string_view own) {
    if (is_in(own)) path = "config." + path;
  };
  DanceManner::VisitSettings([&](const SettingRow& row, const auto&) { add_config(row.name); },
                             DanceManner());
  KnownMusic::VisitFacts([&](const char* name, const auto&) { add_config(name); }, KnownMusic());
  for (const auto& [own, sent] : kPaths)
    if (is_in(own)) return std::string(sent).append(field.substr(own.size()));
  return path;
}

std::string WithRemedy(std::string text, Remedy remedy) {
  for (const auto& [known, path] : kRemedies)
    if (known == remedy) text.append(" (").append(path).append(")");
  return text;
}

Error AsSent(const Error& error) {
  return {error.code(), PathOf(error.field()), WithRemedy(error.Of("").what(), error.remedy()),
          error.remedy()};
}

}  // namespace choreo::wire
