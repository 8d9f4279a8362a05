#include "client/cli/edit/working_dance.h"

#include <iostream>
#include <tuple>
#include <utility>

#include "client/authoring/keys/key_faults.h"
#include "client/cli/edit/key_room.h"
#include "client/cli/report/dance_file.h"
#include "client/cli/report/report.h"
#include "model/core/rounded.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

void NoteUnknown(const EditOptions& options) {
  std::cerr << "note: without --report the dance's keys"
            << (options.song.empty() ? " and song are not known: new frames follow no music, and"
                                     : " are not known:")
            << " keys near an edit are danced over\n";
}

}  // namespace

WorkingDance::WorkingDance(const EditOptions& options, const Connection& connection)
    : options_(options),
      client_(connection.client()),
      reach_(options, connection.model(options.model)) {
  const client::ModelDescription& model = connection.model(options.model);
  dance_ = ReadDance(options.dance, model.skeleton);
  DanceTimes times{.frames = CountModelFrames(dance_, model), .fps = model.fps};
  ReportFile known;
  if (!options.report.empty())
    known = FitReport(options.known, options.report, times.frames, times.fps, dance_.motion);
  else
    NoteUnknown(options);
  const int64_t added = options.loop ? reach_.LoopOf(known.keys, times.frames).added : 0;
  std::tie(settings_, times.counts) =
      HowToDance(options, connection, times.Seconds(times.frames + added));
  path_ = settings_.controls.root_path;
  times.format = {times.fps, UsesCounts(options) ? times.counts : authoring::Counts()};
  options.controls.RequireBegun(settings_.controls, {times.frames, times.fps});
  report_ = {std::move(known), std::move(times)};
}

Pose WorkingDance::PoseAt(int64_t frame) const {
  return choreo::PoseAt(dance_.motion, times().Seconds(frame));
}

std::vector<client::KeyPose> WorkingDance::KeysAsDanced(int64_t first, int64_t end) const {
  const ReportKeys& keys = report_.keys();
  std::vector<client::KeyPose> danced;
  for (auto key = keys.lower_bound(first); key != keys.end() && key->first < end; ++key) {
    danced.push_back({.id = key->second.id,
                      .frame = key->first,
                      .pose = PoseAt(key->first),
                      .hit = key->second.hit,
                      .hands = key->second.hands});
  }
  return danced;
}

void WorkingDance::Set(const char* field, const std::string& done, double at_s,
                       client::KeyEdit edit) {
  edit.key.frame = authoring::FrameForKey(*edit.key.frame);
  const int64_t frames = times().frames;
  const int64_t first = *edit.key.frame;
  const int64_t last = LastFrame(edit);
  edit.from = first == 0 ? -1 : reach_.Before(report_, first);
  edit.to = last == frames - 1 ? frames : reach_.After(report_, last);
  for (const auto& [frame, other] : {std::pair(first, edit.from), {last, edit.to}}) {
    if (other < 0 || other >= frames) continue;
    CheckDistance(times(), field, at_s + times().Seconds(frame - first), other,
                  report_.keys().contains(other) ? "the key" : "an end of the dance,");
  }
  Prepare(&edit);
  WarnOfFaults(edit);
  Apply(client::SetKey(client_, dance_, settings_, edit), done + " key " + edit.key.id);
  report_.Record(edit);
}

void WorkingDance::Free(const std::vector<int64_t>& frames, const std::string& what) {
  report_.Forget(frames.front(), frames.back() + 1);
  client::Gap gap{.from = reach_.Before(report_, frames.front()),
                  .to = frames.back() == times().frames - 1 ? times().frames
                                                            : reach_.After(report_, frames.back())};
  Prepare(&gap);
  Apply(client::DanceAnew(client_, dance_, settings_, gap), what);
}

void WorkingDance::DanceAnew(const std::string& what, int64_t from, int64_t to) {
  client::Gap gap{.from = from, .to = to, .keys = KeysAsDanced(from + 1, to)};
  if (const auto& path = settings_.controls.root_path;
      path && options_.controls.IsOption(kRootPath)) {
    // The new path determines the places of the keys.
    for (client::KeyPose& key : gap.keys)
      if (*key.frame >= path->frames.front() && *key.frame <= path->frames.back())
        key.mask.root_position = false;
  }
  const ReportKeys& keys = report_.keys();
  const ReportKeys before(keys.upper_bound(from), keys.lower_bound(to));
  Prepare(&gap);
  const bool is_all = from < 0 && to == times().frames;
  Apply(is_all ? client::DanceAllAnew(client_, dance_, settings_, gap.keys)
               : client::DanceAnew(client_, dance_, settings_, gap),
        what);
  report_.Restore(before);
}

void WorkingDance::LeadBack(const EditReach::Loop& loop) {
  report_.Refresh(loop.from, times().frames);
  report_.Lengthen(loop.added);
  FollowPath(times().frames, times().frames);  // the way back leaves it
  Apply(client::CloseLoop(client_, dance_, settings_, loop.from, loop.added), "loop");
}

void WorkingDance::Write() const {
  WriteEdited(options_, settings_.model.skeleton, dance_, report_.file(), times().frames);
}

template <class Edit>
void WorkingDance::Prepare(Edit* edit) {
  if (const auto next = report_.keys().find(edit->to); next != report_.keys().end()) {
    edit->to_id = next->second.id;
    edit->to_hit = next->second.hit;
  }
  report_.Refresh(edit->from, edit->to);
  FollowPath(edit->from, edit->to);
}

void WorkingDance::WarnOfFaults(const client::KeyEdit& edit) {
  std::vector<TimedPose> around;
  for (const int64_t frame : {edit.from, edit.to}) {
    if (frame < 0 || frame >= times().frames) continue;
    const double second = times().Seconds(frame);
    around.push_back({report_.keys().contains(frame) ? report_.IdAt(frame) : Rounded(second) + " s",
                      second, PoseAt(frame)});
  }
  const auto faults = authoring::KeyFaults(edit.key, LastFrame(edit), times().fps,
                                           settings_.model.skeleton, around);
  ShowWarnings(faults, times().format);
  report_.Keep(faults);
}

void WorkingDance::FollowPath(int64_t from, int64_t to) {
  if (options_.controls.IsOption(kRootPath)) return;
  // The server warns of a path without effect.
  const bool leads =
      path_ && from < to && path_->frames.front() < to && path_->frames.back() > from;
  settings_.controls.root_path = leads ? path_ : std::nullopt;
}

void WorkingDance::Apply(client::EditedDance edited, const std::string& what) {
  ShowWarnings(edited.warnings, times().format);
  report_.Keep(edited.warnings);
  dance_ = std::move(edited.dance);
  std::cout << what << ": frames " << edited.first_changed << " to " << edited.end_changed - 1
            << " of " << dance_.motion.frames.size() << " are new";
  for (const client::KeyReached& key : edited.keys) {
    report_.Reached(key);
    if (&key != &edited.keys.front()) continue;  // a held pose needs only one figure
    std::cout << "; hit at " << times().format.Of(key.frame) << " within "
              << Rounded(1000 * key.final_error_m) << " mm and " << Rounded(key.final_error_deg)
              << " degrees";
  }
  std::cout << std::endl;
}

}  // namespace choreo::cli
