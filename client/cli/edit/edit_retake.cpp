// Generates frames again, with the keys where they are.
#include <iostream>
#include <string>

#include "client/cli/edit/edits.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"

namespace choreo::cli {
namespace {

constexpr double kLeastTake = 0.5;  // seconds in which people change pose and come back

/// Writes the beats of the options, if any, into the report.
void RenameBeats(const EditOptions& options, const client::EditOptions& changed,
                 DanceSettings* settings) {
  if (options.beats == authoring::BeatOptions()) return;
  settings->beats.clear();
  settings->downbeats.clear();
  if (options.beats == authoring::BeatOptions{.beats = "auto"}) return;  // as are found in the song
  settings->beats = changed.known.music_beats;
  settings->downbeats = changed.known.music_downbeats;
}

}  // namespace

void Retake(double from_s, double until_s, WorkingDance* dance) {
  const DanceTimes& times = dance->times();
  const int64_t first = times.FrameInDance("--retake", from_s);
  const int64_t from = first == 0 ? -1 : first;  // nothing is before the beginning
  const int64_t until = times.FrameInDance("--retake", until_s);
  const int64_t to = until < times.frames - 1 ? until : times.frames;
  if (to - from <= kMinKeyDistance) {
    throw InvalidArgument("--retake", Rounded(from_s) + " s to " + Rounded(until_s) +
                                          " s leaves no room in the dance: at least " +
                                          std::to_string(kMinKeyDistance) +
                                          " frames between these two are danced anew");
  }
  if (until - first < times.Frame(kLeastTake)) {
    std::cerr << "note: " << Rounded(times.Seconds(until - first))
              << " s are danced anew: in less than " << kLeastTake
              << " s nothing much can change\n";
  }
  dance->DanceAnew(
      "take of " + Rounded(times.Seconds(first)) + " to " + Rounded(times.Seconds(to)) + " s", from,
      to);
  dance->report().settings().take_seed = dance->settings().seed;  // the next take has the next one
}

void DanceOtherwise(const EditOptions& options, WorkingDance* dance) {
  const client::EditOptions& changed = dance->settings();
  DanceSettings& settings = dance->report().settings();
  RenameBeats(options, changed, &settings);
  if (options.changed == DanceChange::kCounts) {
    std::cerr << "note: --downbeat alone renames counts; all frames and keys stay\n";
    return;
  }
  if (options.beats != authoring::BeatOptions()) {
    std::cerr << "note: to other beats all frames are danced anew, through the same keys at the "
                 "same seconds\n";
  }
  const auto& path = changed.controls.root_path;
  const bool begins_later = options.changed == DanceChange::kPath && path->frames.front() > 0;
  dance->DanceAnew("danced anew", begins_later ? path->frames.front() : -1, dance->times().frames);
  static_cast<DanceManner&>(settings) = changed.manner;
  settings.seed = changed.seed;
  settings.take_seed.reset();
  ControlRequest::VisitControls(
      [&](size_t row, auto& known, const auto& control) {
        if (options.controls.IsOption(row)) known = control;
      },
      settings.controls, changed.controls);
}

void CloseLoop(WorkingDance* dance) {
  EditedReport& report = dance->report();
  const DanceTimes& times = dance->times();
  const EditReach::Loop loop = dance->reach().LoopOf(report.keys(), times.frames);
  for (auto key = report.keys().upper_bound(loop.from); key != report.keys().end(); ++key) {
    std::cerr << "warning: key " << key->second.id << " at " << times.format.Of(key->first)
              << " makes way for the loop\n";
  }
  report.Forget(loop.from + 1, times.frames);
  if (loop.added > 0) {
    std::cerr << "note: the pose that is held at the end stays; the way back makes the dance "
              << Rounded(times.Seconds(loop.added)) << " s longer\n";
  }
  dance->LeadBack(loop);
}

}  // namespace choreo::cli
