#include "client/cli/options/authoring_options.h"

#include <algorithm>

#include "client/authoring/controls/velocities.h"
#include "client/cli/options/options.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

std::string VelocityHelp() {
  return "How fast a part of the body moves: trunk, left_arm, right_arm, left_leg, right_leg, "
         "arms, legs or all. left_arm=1.5 is a multiple, 0 to " +
         Rounded(kMaxVelocityFactor) + ", of the reference; left_arm=1.2cm is a speed, 0 to " +
         Rounded(100 * kMaxVelocity) +
         " cm a frame. Use one unit in a command. Or a JSON file of changes: {\"factors\": "
         "[{\"time\": 0, \"arms\": 1}, {\"time\": 4, \"arms\": 3}]}, or \"speeds\". Repeatable; "
         "the last value of a part counts.";
}

std::string FileHelp(const ControlRow& row) {
  if (row.name == kControls[kRootPath].name) {
    return "JSON file of the dancer's path: {\"points\": [{\"time\": 0, \"x\": 0, \"z\": 0}, "
           "...]}, seconds and metres; y is the root's height. Keys override the path; its heights "
           "override keys without a position. For models that have this control (`choreo info`).";
  }
  return "JSON file with the fields of " + std::string(row.name) +
         " in the API's Controls. For models that have this control (`choreo info`).";
}

}  // namespace

CLI::Validator SongFile() {
  CLI::Validator validator(
      [](std::string& name) -> std::string {
        if (name == "-") return {};
        std::string refusal = CLI::ExistingFile(name);
        if (!refusal.empty() || !IsMotionFile(name)) return refusal;
        return name + " is a motion, not a song; choreo edit changes it";
      },
      "FILE", "song");
  return validator;
}

void AddBeatOptions(CLI::App& command, authoring::BeatOptions* options) {
  CLI::Option* beats =
      command.add_option("--beats", options->beats,
                         "FILE with the song's beats, one a line: the second and, if known, the "
                         "count in the bar (1: a downbeat). auto: find the beats. Default: auto; "
                         "for edits the beats of the dance's report.");
  command
      .add_option("--tempo", options->hint.tempo_bpm,
                  "Rough tempo, " + Rounded(kSlowestHint) + " to " + Rounded(kFastestHint) +
                      " beats a minute. Beats are sought within 6 % of it.")
      ->check(NumberFrom(kSlowestHint, kFastestHint))
      ->excludes(beats);
  CLI::Option* half =
      command.add_flag("--half-time", options->hint.half_time, "Use every second beat only.");
  command.add_flag("--double-time", options->hint.double_time, "Add a beat half way between two.")
      ->excludes(half);
  command
      .add_option("--downbeat", options->downbeat_s,
                  "A second of the song; the nearest beat is the first of its bar.")
      ->check(TimeInSeconds());
}

void AddControlOptions(CLI::App& command, authoring::WrittenControls* controls,
                       std::span<const ControlRow> rows) {
  for (const ControlRow& row : rows) {
    authoring::WrittenControl& written = (*controls)[row.name];
    if (row.name == kControls[kVelocityFactors].name) {
      AddRepeated(command, "--velocity", written.sources, VelocityHelp());
      command.add_option("--velocity-reference", written.reference,
                         "What --velocity multiplies: a reference that `choreo info` lists. "
                         "Default: the model's first.");
      continue;
    }
    command.add_option(std::string(row.option), written.sources, FileHelp(row))
        ->expected(1)
        ->check([](const std::string& file) { return file.empty() ? "names no file" : ""; });
  }
}

std::vector<NamedFile> FilesOf(const authoring::WrittenControls& controls) {
  std::vector<NamedFile> files;
  for (size_t row = 0; row < std::size(kControls); ++row) {
    for (const std::string& source : controls.SourcesOf(row)) {
      if (row != kVelocityFactors || authoring::IsVelocityFile(source))
        files.push_back({std::string(kControls[row].option), source});
    }
  }
  return files;
}

}  // namespace choreo::cli
