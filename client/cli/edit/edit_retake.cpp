// Generates another take of a part of a dance.
#include <algorithm>
#include <iostream>

#include "client/cli/edit/edit_session.h"
#include "client/cli/report/report.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"

namespace choreo::cli {
namespace {

constexpr double kLeastTake = 0.5;  // seconds in which people change pose and come back

}  // namespace

void EditSession::Retake(double from_s, double until_s) {
  const int64_t first = FrameInDance("--retake", from_s);
  const int64_t from = first == 0 ? -1 : first;  // nothing is before the beginning
  const int64_t until = FrameInDance("--retake", until_s);
  const int64_t to = until < frames_ - 1 ? until : frames_;
  if (to - from <= kMinKeyDistance) {
    throw InvalidArgument("--retake", Rounded(from_s) + " s to " + Rounded(until_s) +
                                          " s leaves no room in the dance: at least " +
                                          std::to_string(kMinKeyDistance) +
                                          " frames between these two are danced anew");
  }
  if (until - first < Frame(kLeastTake)) {
    std::cerr << "note: " << Rounded(Seconds(until - first)) << " s are danced anew: in less than "
              << kLeastTake << " s nothing much can change\n";
  }
  DanceAnew("take of " + Rounded(Seconds(first)) + " to " + Rounded(Seconds(to)) + " s", from, to);
  known_.settings.seed = edit_.seed;  // the next take has the next seed
}

void EditSession::RenameBeats() {
  if (options_.beats == authoring::BeatOptions()) return;
  DanceSettings& settings = known_.settings;
  settings.beats.clear();
  settings.downbeats.clear();
  if (options_.beats == authoring::BeatOptions{.beats = "auto"})
    return;  // as are found in the song
  settings.beats = edit_.music_beats;
  settings.downbeats = edit_.music_downbeats;
}

void EditSession::DanceOtherwise() {
  RenameBeats();
  if (options_.changed == DanceChange::kCounts) {
    std::cerr << "note: --downbeat alone renames counts; all frames and keys stay\n";
    return;
  }
  if (options_.beats != authoring::BeatOptions()) {
    std::cerr << "note: to other beats all frames are danced anew, through the same keys at the "
                 "same seconds\n";
  }
  const auto& path = edit_.controls.root_path;
  const bool begins_later = options_.changed == DanceChange::kPath && path->frames.front() > 0;
  DanceAnew("danced anew", begins_later ? path->frames.front() : -1, frames_);
  DanceSettings& settings = known_.settings;
  static_cast<DanceManner&>(settings) = edit_;
  settings.seed = edit_.seed;
  ControlRequest::VisitControls(
      [&](size_t row, auto& known, const auto& changed) {
        if (options_.controls.IsOption(row)) known = changed;
      },
      settings.controls, edit_.controls);
}

void EditSession::DanceAnew(const std::string& what, int64_t from, int64_t to) {
  client::Gap gap{.from = from, .to = to, .keys = KeysAsDanced(from + 1, to)};
  if (const auto& path = edit_.controls.root_path; path && options_.controls.IsOption(kRootPath)) {
    // The new path determines the places of the keys.
    for (client::KeyPose& key : gap.keys)
      if (*key.frame >= path->frames.front() && *key.frame <= path->frames.back())
        key.mask.root_position = false;
  }
  if (keys_.contains(to)) {
    gap.to_id = IdAt(to);
    gap.to_hit = keys_.at(to).hit;
  }
  const ReportKeys before(keys_.upper_bound(from), keys_.lower_bound(to));
  Refresh(from, to);
  FollowPath(from, to);
  const bool is_all = from < 0 && to == frames_;
  Apply(is_all ? client::DanceAllAnew(client_, dance_, edit_, gap.keys)
               : client::DanceAnew(client_, dance_, edit_, gap),
        what);
  for (const auto& [frame, key] : before) {
    ReportKey& anew = keys_.at(frame);
    anew.holds = key.holds;
    anew.hit = key.hit;
    anew.hands = key.hands;
  }
}

}  // namespace choreo::cli
