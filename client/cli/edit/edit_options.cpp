#include "client/cli/edit/edit_options.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <type_traits>
#include <utility>

#include "client/cli/options/options.h"
#include "client/cli/report/report.h"
#include "client/cli/report/report_controls.h"
#include "model/core/files/atomic_file.h"
#include "model/core/joined.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"
#include "model/motion/controls/controls.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

std::optional<authoring::Music> ReadSong(const EditOptions& options, double end_s) {
  authoring::RequireSong(options.beats, options.song);
  if (options.song.empty()) return std::nullopt;
  return authoring::ReadMusic(options.song, end_s, options.song_start_s, options.beats);
}

/// The report's beats and downbeats, or else the music's.
std::pair<std::vector<double>, std::vector<double>> BeatsOf(
    const EditOptions& options, const std::optional<authoring::Music>& music) {
  if (!music) return {};
  const DanceSettings& settings = options.settings;
  if (!settings.beats.empty()) return {settings.beats, settings.downbeats};
  return {music->track.Seconds(), music->track.DownbeatSeconds()};
}

authoring::Counts CountsOf(const EditOptions& options,
                           const std::optional<authoring::Music>& music) {
  auto [beats, downbeats] = BeatsOf(options, music);
  return authoring::CountsFrom(std::move(beats), downbeats);
}

/// Sets the beats from the report that the options do not replace.
void FillBeats(bool says_start, EditOptions* options) {
  DanceSettings& settings = options->settings;
  const BeatHint& hint = options->beats.hint;
  if (options->beats.beats || hint.tempo_bpm || options->song.empty() || says_start)
    settings.beats.clear();
  if (settings.beats.empty()) return;
  if ((hint.half_time || hint.double_time) && (EditsKeys(*options) || EditsWhole(*options))) {
    throw InvalidArgument(hint.half_time ? "--half-time" : "--double-time",
                          options->report +
                              " has the dance's beats, perhaps changed like this; change them in "
                              "an edit of their own, or choose which beats to change: --beats "
                              "auto, or --beats FILE");
  }
  authoring::ChangeBeats(options->beats, options->song_start_s, &settings.beats,
                         &settings.downbeats);
}

/// Whether a dance of `frames` at `fps` has the file's number of frames at the file's rate. Its
/// last frames, after the file's last frame, may be missing.
bool IsShortenedTo(const Motion& file, int64_t frames, double fps) {
  const double after_s = static_cast<double>(frames - 1) / fps - Duration(file);
  return after_s > 0 && after_s * file.fps < 1 - kOnFrame;
}

/// Fills in controls from the report that the command line does not give and the model supports.
void FillControls(const ControlRequest& known, const client::ModelDescription& model,
                  ControlRequest* controls) {
  const auto take = [&](size_t row, const auto& from, auto& to) {
    if (!from || to) return;
    const std::string name(kControls[row].name);
    if (std::ranges::find(model.controls, name) != model.controls.end()) {
      to = from;
    } else {
      std::cerr << "note: the model \"" << model.name << "\" does not have the control " << name
                << ", which the report states\n";
    }
  };
  ControlRequest::VisitControls(take, known, *controls);
}

std::string Shown(const std::string& text) { return text; }
std::string Shown(const std::optional<uint64_t>& number) { return std::to_string(*number); }
std::string Shown(const std::optional<double>& number) { return InFull(*number); }

DanceChange ChangeOf(const EditOptions& options) {
  bool other = false;
  const auto is_stated = [&other](const SettingRow&, const auto& setting) {
    other = other || setting != std::remove_cvref_t<decltype(setting)>();
  };
  DanceManner::VisitSettings(is_stated, options);
  for (size_t row = 0; row < std::size(kControls); ++row)
    other = other || (row != kRootPath && options.controls.IsOption(row));
  if (other) return DanceChange::kOther;
  if (options.controls.IsOption(kRootPath))
    return options.seed ? DanceChange::kOther : DanceChange::kPath;
  return options.seed ? DanceChange::kSeed : DanceChange::kNothing;
}

/// What the options of beats change as well.
DanceChange WithBeats(const authoring::BeatOptions& beats, DanceChange change) {
  authoring::BeatOptions times = beats;
  times.downbeat_s.reset();
  if (times != authoring::BeatOptions()) return DanceChange::kOther;
  return beats.downbeat_s ? std::max(change, DanceChange::kCounts) : change;
}

}  // namespace

bool EditsKeys(const EditOptions& options) {
  return !options.keys.empty() || !options.moves.empty() || !options.removed.empty() ||
         !options.repeats.empty() || !options.stretches.empty() || !options.mirrored.empty() ||
         !options.retakes.empty() || !options.end.empty() || options.loop;
}

bool EditsWhole(const EditOptions& options) {
  return !options.from.empty() || !options.until.empty() || options.mirror || !options.join.empty();
}

void FillFromReport(bool says_start, EditOptions* options) {
  std::vector<std::string> taken;
  const auto take = [&](std::string name, const auto& from, auto& to) {
    if (from == std::remove_cvref_t<decltype(from)>()) return;
    if (to != std::remove_cvref_t<decltype(to)>()) return;
    to = from;
    std::ranges::replace(name, '_', ' ');
    taken.push_back(name + " " + Shown(from));
  };
  DanceSettings& settings = options->settings;
  if (!options->report.empty()) options->known = ReadReport(options->report);
  settings = options->known.settings;
  if (settings.FillSong(options->report, says_start, "new frames do not follow the music",
                        &options->song, &options->song_start_s)) {
    taken.push_back("song " + options->song);
  }
  FillBeats(says_start, options);
  take("model", settings.model, options->model);
  options->changed = ChangeOf(*options);
  // Another take needs another seed, unless other settings change.
  if (!options->retakes.empty() && options->changed == DanceChange::kNothing) {
    options->seed = settings.take_seed.value_or(settings.seed.value_or(0)) + 1;
    std::cerr << "note: retakes use seed " << *options->seed << "; another --seed gives others\n";
  }
  options->changed = WithBeats(options->beats, options->changed);
  take("seed", settings.seed, options->seed);
  DanceManner::VisitSettings(
      [&](const SettingRow& row, const auto& from, auto& to) { take(row.name, from, to); },
      settings, *options);
  ControlRequest::VisitControls(
      [&](size_t row, const auto& control) {
        if (control && !options->controls.IsOption(row))
          taken.push_back("the " + MemberOf(kControls[row]));
      },
      settings.controls);
  if (!taken.empty()) {
    std::cerr << "note: as " << options->report << " says: " << Joined(taken, std::identity())
              << '\n';
  }
}

std::vector<std::pair<const char*, std::string>> TimesOf(const EditOptions& options) {
  std::vector<std::pair<const char*, std::string>> times;
  const auto add = [&](const char* option, const std::string& time) {
    if (!time.empty()) times.emplace_back(option, time);
  };
  for (const std::string& time : options.at) add("--at", time);
  for (const auto& [id, time] : options.moves) add("--move", time);
  for (const auto& [from, until, later] : options.repeats)
    for (const std::string& time : {from, until, later}) add("--repeat", time);
  for (const auto& [from, until, factor] : options.stretches)
    for (const std::string& time : {from, until}) add("--stretch", time);
  for (const auto& [from, until] : options.mirrored)
    for (const std::string& time : {from, until}) add("--mirror-phrase", time);
  for (const auto& [from, until] : options.retakes)
    for (const std::string& time : {from, until}) add("--retake", time);
  add("--hold", options.hold);
  add("--from", options.from);
  add("--until", options.until);
  return times;
}

bool UsesCounts(const EditOptions& options) {
  return std::ranges::any_of(TimesOf(options), [](const auto& time) {
    return authoring::ParseTime(time.second, time.first).counts;
  });
}

std::tuple<client::EditOptions, authoring::Counts> HowToDance(const EditOptions& options,
                                                              const Connection& connection,
                                                              double end_s) {
  client::EditOptions edit;
  edit.model = connection.model(options.model);
  edit.seed = options.seed.value_or(0);
  edit.manner = options;
  const auto music = ReadSong(options, end_s);
  const authoring::Counts counts = CountsOf(options, music);
  if (music) {
    edit.audio = authoring::AudioFor(music->audio, end_s);
    std::tie(edit.known.music_beats, edit.known.music_downbeats) = BeatsOf(options, music);
    authoring::FillInMusic(*music, end_s, &edit.known);
  }
  edit.controls = options.controls.Read(edit.model, connection.server(), counts);
  FillControls(options.settings.controls, edit.model, &edit.controls);
  if (edit.manner.style != options.settings.style) NoteStyle(edit.model, edit.manner.style);
  NoteDeterministic(edit.model, {{"--seed", options.seed != options.settings.seed},
                                 {"--temperature", edit.manner.temperature.value_or(0) != 0}});
  return {std::move(edit), counts};
}

authoring::Counts ReadCounts(const EditOptions& options, double end_s) {
  return CountsOf(options, ReadSong(options, end_s));
}

ReportFile FitReport(ReportFile report, const std::string& name, int64_t frames, double fps,
                     const Motion& file) {
  if (report.fps != fps) {
    std::ostringstream message;
    message << report.fps << ", but the model runs at " << fps;
    throw InvalidArgument(name + ":fps", message.str());
  }
  const int64_t said = report.frames.value_or(frames);
  if (said != frames && !IsShortenedTo(file, said, fps)) {
    throw InvalidArgument(name + ":frames", std::to_string(said) + ", but the dance has " +
                                                std::to_string(frames) +
                                                ": this is another dance's report");
  }
  CheckSketch(name, report, file);
  if (const auto key = report.keys.lower_bound(said); key != report.keys.end()) {
    throw InvalidArgument(name + ":keyframes", key->second.id + " stands at frame " +
                                                   std::to_string(key->first) +
                                                   ", but the dance has " + std::to_string(frames) +
                                                   ": it is the report of another one");
  }
  if (const auto missing = report.keys.lower_bound(frames); missing != report.keys.end()) {
    ReportKey last = report.keys.rbegin()->second;
    last.frame = frames - 1;
    report.keys.erase(missing, report.keys.end());
    report.keys.insert_or_assign(last.frame, std::move(last));
  }
  report.frames = frames;
  return report;
}

void WriteEdited(const EditOptions& options, const Skeleton& skeleton,
                 const client::FinishedDance& dance, ReportFile report, int64_t frames) {
  WriteMotion(options.out, skeleton, dance.motion,
              dance.contacts.empty() ? nullptr : &dance.contacts);
  report.faults = FindDanceFaults(skeleton, dance.motion, report.fps);
  std::cout << FaultsText(report.faults, options.out) << options.out << std::endl;
  if (options.new_report.empty()) return;
  report.frames = frames;
  report.sketch = SketchOf(dance.motion, frames, report.fps);
  nlohmann::ordered_json written;
  report.WriteTo(&written);
  WriteFile(options.new_report, written.dump(2) + "\n");
}

}  // namespace choreo::cli
