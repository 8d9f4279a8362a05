#include "client/cli/edit/edit_session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

#include "client/authoring/counts.h"
#include "client/authoring/dance_keys.h"
#include "client/authoring/key_faults.h"
#include "client/authoring/key_file.h"
#include "client/authoring/pose_library.h"
#include "client/authoring/pose_source.h"
#include "client/cli/report/dance_file.h"
#include "client/cli/report/report.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

/// Least seconds for a visible return from a held pose into the dance.
constexpr double kLeastAfterHold = 1;

void NoteUnknown(const EditOptions& options) {
  std::cerr << "note: without --report the dance's keys"
            << (options.song.empty() ? " and song are not known: new frames follow no music, and"
                                     : " are not known:")
            << " keys near an edit are danced over\n";
}

}  // namespace

EditSession::EditSession(const EditOptions& options, const Connection& connection)
    : options_(options), client_(connection.client()) {
  edit_.model = connection.model(options.model);
  longest_ = edit_.model.max_transition_frames - 1;
  if (options.around_s) CheckAround(*options.around_s);
  dance_ = ReadDance(options.dance, edit_.model.skeleton);
  frames_ = CountModelFrames(dance_, edit_.model);
  if (!options.report.empty())
    known_ = FitReport(options.known, options.report, frames_, edit_.model.fps, dance_.motion);
  else
    NoteUnknown(options);
  const int64_t end = frames_ + (options.loop ? LoopFrames().added : 0);
  std::tie(edit_, counts_) = HowToDance(options, connection, Seconds(end));
  path_ = edit_.controls.root_path;
  times_ = {edit_.model.fps, UsesCounts(options) ? counts_ : authoring::Counts()};
  options.controls.RequireBegun(edit_.controls, {frames_, edit_.model.fps});
  CheckKeys();
}

void EditSession::SetKey(const std::string& source, double at_s) {
  const authoring::NamedPose named = ReadKeyPose(source);
  // The library's poses are known to bend correctly.
  if (named.has_place && !options_.allow_bends)
    authoring::RefuseBends({{named.key}, {source}}, edit_.model.skeleton);
  client::KeyEdit edit;
  edit.key = named.key;
  edit.key.frame = FrameInDance("--at", at_s);
  const GroundFrame here = Here(*edit.key.frame);
  Pose& pose = edit.key.pose;
  if (!named.has_place) {
    pose = options_.placing.From(here).ToWorld(pose);
  } else {
    if (options_.in_place) pose = here.ToWorld(GroundFrame::Of(pose).ToLocal(pose));
    authoring::PlaceRoot(options_.placing, "--place", &edit.key);
  }
  edit.held = named.held;
  if (!options_.hands.empty()) edit.key.hands = FindHandPose(options_.hands);
  if (options_.hit) edit.key.hit = options_.hit;
  HoldAsAsked(source, at_s, &edit);
  const std::vector<client::Warning> ended = MakeRoom("--at", &edit);
  Set("--at", at_s, std::move(edit));
  Keep(ended);
}

authoring::NamedPose EditSession::ReadKeyPose(const std::string& source) const {
  const bool is_key = std::ranges::any_of(keys_, [&](const auto& key) {
    return source == key.second.id || source.starts_with(key.second.id + '@');
  });
  if (!is_key || std::filesystem::exists(authoring::FileOf(source)) ||
      std::ranges::find(authoring::PoseLibrary(), source, &authoring::LibraryPose::id) !=
          authoring::PoseLibrary().end())
    return authoring::ReadPose(source, edit_.model.skeleton, counts_);
  const std::vector<int64_t> frames = FindKey(keys_, source, edit_.model.fps, "--key", counts_);
  const GroundFrame there = Here(frames.front());
  authoring::NamedPose named;
  named.has_place = false;
  for (client::KeyPose& key : KeysAsDanced(frames.front(), frames.back() + 1)) {
    key.time_s = Seconds(*key.frame);
    key.frame.reset();
    key.pose = there.ToLocal(key.pose);
    (named.key.id.empty() ? named.key : named.held.emplace_back()) = std::move(key);
  }
  std::cerr << "note: \"" << named.key.id << "\" is the report's key at "
            << times_.Of(frames.front()) << "; its pose is set where the dancer is\n";
  return named;
}

void EditSession::HoldAsAsked(const std::string& source, double at_s, client::KeyEdit* edit) {
  client::KeyPose& key = edit->key;
  if (!options_.hold.empty()) {
    const double until_s =
        authoring::ParseTime(options_.hold, "--hold").After(at_s, counts_, "--hold");
    edit->held = authoring::Holding(&key, until_s - at_s, "--hold");
  }
  if (edit->held.empty()) return;
  authoring::RefuseHeldInAir(key, edit->held.back().time_s - key.time_s,
                             options_.hold.empty() ? source : "--hold", edit_.model.skeleton);
  for (client::KeyPose& held : edit->held) {
    held.frame = Frame(at_s + held.time_s - key.time_s);
    held.pose = key.pose;
    held.hands = key.hands;
  }
}

void EditSession::RemoveKey(const std::string& id) {
  const std::vector<int64_t> frames = FindKey(keys_, id, edit_.model.fps, "--remove", counts_);
  if (frames.front() == 0) {
    throw InvalidArgument("--remove", "\"" + IdAt(0) +
                                          "\" is the first frame, where the dance begins; set "
                                          "another key there instead: --key POSE --at 0");
  }
  Free(frames, "removed " + IdAt(frames.front()));
}

void EditSession::MoveKey(const std::string& id, double to_s) {
  const std::vector<int64_t> frames = FindKey(keys_, id, edit_.model.fps, "--move", counts_);
  const int64_t by = FrameInDance("--move", to_s) - frames.front();
  if (frames.front() == 0 && by != 0) {
    throw InvalidArgument("--move", "\"" + IdAt(0) +
                                        "\" is the first frame, where the dance begins; set it at "
                                        "another second with --key");
  }
  client::KeyEdit edit;
  for (const int64_t frame : frames) {
    client::KeyPose& key = frame == frames.front() ? edit.key : edit.held.emplace_back();
    key.id = IdAt(frame);
    key.hands = options_.hands.empty() ? keys_.at(frame).hands : FindHandPose(options_.hands);
    key.pose = PoseAt(dance_.motion, Seconds(frame));
    key.frame = frame + by;
    if (options_.in_place)
      key.pose = Here(frames.front() + by).ToWorld(Here(frames.front()).ToLocal(key.pose));
  }
  edit.key.hit = options_.hit ? options_.hit : keys_.at(frames.front()).hit;
  if (!options_.hold.empty()) HoldAsAsked(edit.key.id, to_s, &edit);
  Forget(keys_.find(frames.front()), keys_.upper_bound(frames.back()));
  const std::vector<client::Warning> ended = MakeRoom("--move", &edit);
  // The frames generated again around the new place may not include the old one.
  const auto is_new = [&](int64_t frame) {
    return frame > Before(frames.front() + by) && frame < After(LastFrame(edit));
  };
  if (!Reaches(std::abs(by)) || !std::ranges::all_of(frames, is_new))
    Free(frames, edit.key.id + " leaves its place");
  Set("--move", to_s, std::move(edit));
  Keep(ended);
}

std::vector<client::Warning> EditSession::MakeRoom(const char* field, client::KeyEdit* edit) {
  const int64_t first = *edit->key.frame;
  if (set_.contains(first) && keys_.contains(first)) {
    throw InvalidArgument(field, Rounded(Seconds(first)) + " s for \"" + edit->key.id +
                                     "\" is where this edit sets \"" + IdAt(first) + "\" already");
  }
  std::vector<client::Warning> warnings = EndHold(first, edit->key.id);
  MakeWay(first, first, edit->key.id);
  const std::vector<client::Warning> fitted = FitHold(edit);
  warnings.insert(warnings.end(), fitted.begin(), fitted.end());
  MakeWay(first, LastFrame(*edit), edit->key.id);
  return warnings;
}

std::vector<client::Warning> EditSession::FitHold(client::KeyEdit* edit) {
  if (edit->held.empty()) return {};
  const int64_t first = *edit->key.frame;
  const int64_t was = LastFrame(*edit);
  const auto next = keys_.upper_bound(first);
  if (next == keys_.end()) {
    if (frames_ - was >= Frame(kLeastAfterHold)) return {};
    HoldUntil(frames_ - 1, edit);
    if (std::abs(frames_ - 1 - was) > 1) {
      std::cerr << "note: key \"" << edit->key.id << "\" is held to the end, "
                << Rounded(Seconds(frames_ - 1)) << " s, not " << Rounded(Seconds(was)) << " s\n";
    }
    return {};
  }
  if (next->first > was) return {};
  HoldUntil(next->first - Frame(authoring::kWayFromHold), edit);
  const client::Warning warning{
      .frame = next->first,
      .message = authoring::DescribeHoldEnd(edit->key.id, LastFrame(*edit), was, IdAt(next->first),
                                            next->first, edit_.model.fps)};
  ShowWarnings({warning}, times_);
  return {warning};
}

std::vector<client::Warning> EditSession::EndHold(int64_t frame, const std::string& id) {
  const auto next = keys_.lower_bound(frame);
  if (next == keys_.begin() || next == keys_.end() || next->second.holds.empty()) return {};
  auto held = std::prev(next);
  while (held != keys_.begin() && !held->second.holds.empty()) --held;
  auto last = next;
  while (std::next(last) != keys_.end() && !std::next(last)->second.holds.empty()) ++last;
  const auto dropped =
      keys_.upper_bound(std::max(held->first, frame - Frame(authoring::kWayFromHold)));
  const client::Warning warning{
      .frame = frame,
      .message = authoring::DescribeHoldEnd(IdAt(held->first), std::prev(dropped)->first,
                                            last->first, id, frame, edit_.model.fps)};
  Forget(dropped, std::next(last));
  ShowWarnings({warning}, times_);
  return {warning};
}

void EditSession::MakeWay(int64_t first, int64_t last, const std::string& id) {
  const int64_t near = Frame(authoring::kTooNear);
  std::vector<int64_t> gone;
  for (auto key = keys_.lower_bound(std::max<int64_t>(0, first - near + 1));
       key != keys_.end() && key->first < last + near; ++key) {
    const bool stays = key->first != first && (key->first == 0 || set_.contains(key->first));
    if (!stays) gone.push_back(key->first);
  }
  for (const int64_t frame : gone) {
    const auto key = keys_.find(frame);
    if (key == keys_.end()) continue;  // it held a key that was removed
    NoteWay(frame,
            '"' + id + "\": " +
                (frame == first ? "it stands there"
                                : "it is less than " + Rounded(authoring::kTooNear) + " s away"));
    auto end = std::next(key);
    while (end != keys_.end() && !end->second.holds.empty()) ++end;
    Forget(key, end);
  }
}

void EditSession::NoteWay(int64_t frame, const std::string& what) const {
  std::cerr << "note: key \"" << IdAt(frame) << "\" at " << times_.Of(frame) << " makes way for "
            << what << '\n';
}

void EditSession::Set(const char* field, double at_s, client::KeyEdit edit) {
  const int64_t first = *edit.key.frame;
  const int64_t last = LastFrame(edit);
  edit.from = first == 0 ? -1 : Before(first);
  edit.to = last == frames_ - 1 ? frames_ : After(last);
  for (const auto& [frame, other] : {std::pair(first, edit.from), {last, edit.to}}) {
    if (other < 0 || other >= frames_) continue;
    CheckDistance(field, at_s + Seconds(frame - first), other,
                  keys_.contains(other) ? "the key" : "an end of the dance,");
  }
  if (keys_.contains(edit.to)) {
    edit.to_id = IdAt(edit.to);
    edit.to_hit = keys_.at(edit.to).hit;
  }
  for (const client::KeyPose& held : edit.held) set_.insert(*held.frame);
  set_.insert(first);
  Refresh(edit.from, edit.to);
  WarnOfFaults(edit);
  FollowPath(edit.from, edit.to);
  Apply(client::SetKey(client_, dance_, edit_, edit), "key " + edit.key.id);
  keys_[*edit.key.frame].hit = edit.key.hit;
  keys_[*edit.key.frame].hands = edit.key.hands;
  for (const client::KeyPose& held : edit.held) {
    keys_[*held.frame].holds = edit.key.id;
    keys_[*held.frame].hands = held.hands;
  }
}

void EditSession::Forget(ReportKeys::const_iterator begin, ReportKeys::const_iterator end) {
  for (auto key = begin; key != end; ++key) stale_.insert(key->first);
  keys_.erase(begin, end);
}

void EditSession::Free(const std::vector<int64_t>& frames, const std::string& what) {
  Forget(keys_.lower_bound(frames.front()), keys_.upper_bound(frames.back()));
  client::Gap gap{.from = Before(frames.front()),
                  .to = frames.back() == frames_ - 1 ? frames_ : After(frames.back())};
  if (keys_.contains(gap.to)) {
    gap.to_id = IdAt(gap.to);
    gap.to_hit = keys_.at(gap.to).hit;
  }
  Refresh(gap.from, gap.to);
  FollowPath(gap.from, gap.to);
  Apply(client::DanceAnew(client_, dance_, edit_, gap), what);
}

void EditSession::WarnOfFaults(const client::KeyEdit& edit) {
  std::vector<TimedPose> around;
  for (const int64_t frame : {edit.from, edit.to}) {
    if (frame < 0 || frame >= frames_) continue;
    around.push_back({keys_.contains(frame) ? IdAt(frame) : Rounded(Seconds(frame)) + " s",
                      Seconds(frame), PoseAt(dance_.motion, Seconds(frame))});
  }
  const auto faults = authoring::KeyFaults(edit.key, LastFrame(edit), edit_.model.fps,
                                           edit_.model.skeleton, around);
  ShowWarnings(faults, times_);
  Keep(faults);
}

EditSession::Loop EditSession::LoopFrames() const {
  const int64_t end = frames_ - 1;
  const int64_t from = std::max<int64_t>(0, end - Around());
  const std::optional<int64_t> held = HeldEnd(keys_);
  if (!held || *held <= from) return {from, 0};
  return {*held, *held + Around() - end};
}

void EditSession::CloseLoop() {
  const auto [from, added] = LoopFrames();
  for (auto key = keys_.upper_bound(from); key != keys_.end(); key = keys_.erase(key)) {
    std::cerr << "warning: key " << key->second.id << " at " << times_.Of(key->first)
              << " makes way for the loop\n";
  }
  if (added > 0) {
    std::cerr << "note: the pose that is held at the end stays; the way back makes the dance "
              << Rounded(Seconds(added)) << " s longer\n";
  }
  Refresh(from, frames_);
  frames_ += added;
  FollowPath(frames_, frames_);  // the way back leaves it
  Apply(client::CloseLoop(client_, dance_, edit_, from, added), "loop");
}

void EditSession::Write() const {
  WriteMotion(options_.out, edit_.model.skeleton, dance_.motion,
              dance_.contacts.empty() ? nullptr : &dance_.contacts);
  std::cout << options_.out << std::endl;
  if (options_.new_report.empty()) return;
  WriteReport(options_.new_report, known_, frames_, dance_.motion);
}

void EditSession::CheckKeys() const {
  std::map<int64_t, std::string> sources;  // by frame
  for (size_t i = 0; i < options_.keys.size(); ++i) {
    const double at_s = Second("--at", options_.at[i]);
    const auto [same, is_new] = sources.emplace(Frame(at_s), options_.keys[i]);
    if (!is_new) {
      throw InvalidArgument("--key", same->second + " and " + options_.keys[i] + " both ask for " +
                                         times_.Of(same->first));
    }
    if (same != sources.begin()) CheckDistance("--at", at_s, std::prev(same)->first, "the key");
    if (std::next(same) != sources.end())
      CheckDistance("--at", at_s, std::next(same)->first, "the key");
  }
}

int64_t EditSession::FrameInDance(const char* field, double at_s) const {
  // A time at the very end means the last frame, as for keys of a new dance (FitIntoDance).
  const int64_t frame = Frame(at_s) == frames_ ? frames_ - 1 : Frame(at_s);
  if (frame < frames_) return frame;
  throw InvalidArgument(field, Rounded(at_s) +
                                   " s is after the dance, which has its last frame at " +
                                   Rounded(Seconds(frames_ - 1)) + " s");
}

GroundFrame EditSession::Here(int64_t frame) const {
  return GroundFrame::Of(PoseAt(dance_.motion, Seconds(frame)));
}

void EditSession::CheckDistance(const char* field, double at_s, int64_t other,
                                const std::string& what) const {
  const int64_t distance = std::abs(Frame(at_s) - other);
  if (distance >= kMinKeyDistance) return;
  throw InvalidArgument(field, Rounded(at_s) + " s lies " + std::to_string(distance) +
                                   " frame from " + what + " at " + Rounded(Seconds(other)) +
                                   " s, must be at least " + std::to_string(kMinKeyDistance) +
                                   " frames from it");
}

void EditSession::CheckAround(double seconds) const {
  const double frames = std::round(seconds * edit_.model.fps);
  if (frames >= kMinKeyDistance && frames <= static_cast<double>(longest_)) return;
  std::ostringstream message;
  message << seconds << " s, must be " << Rounded(kMinKeyDistance / edit_.model.fps) << " to "
          << Rounded(Seconds(longest_)) << " s: " << kMinKeyDistance << " to " << longest_
          << " frames";
  throw InvalidArgument("--around", message.str());
}

int64_t EditSession::Around() const {
  return std::min(longest_,
                  static_cast<int64_t>(std::llround(
                      options_.around_s.value_or(authoring::kEditAround) * edit_.model.fps)));
}

bool EditSession::Reaches(int64_t frames) const {
  const bool is_told = options_.around_s || options_.report.empty();
  return frames <= (is_told ? Around() : Frame(authoring::kNextKeyNear));
}

int64_t EditSession::Before(int64_t frame) const {
  const auto next = keys_.lower_bound(frame);
  const int64_t key = next == keys_.begin() ? 0 : std::prev(next)->first;
  if (next != keys_.begin() && Reaches(frame - key)) return key;
  int64_t from = frame - Around();
  if (!options_.around_s) {
    const auto stale = stale_.lower_bound(key);
    if (stale != stale_.end() && *stale < frame) from = std::min(from, *stale - Around());
  }
  return std::max({int64_t{0}, key, from, frame - longest_});
}

int64_t EditSession::After(int64_t frame) const {
  const auto next = keys_.upper_bound(frame);
  const int64_t key = next == keys_.end() ? frames_ - 1 : next->first;
  if (next != keys_.end() && Reaches(key - frame)) return key;
  int64_t to = frame + Around();
  if (!options_.around_s) {
    const auto stale = stale_.upper_bound(key);
    if (stale != stale_.begin() && *std::prev(stale) > frame)
      to = std::max(to, *std::prev(stale) + Around());
  }
  return std::min({frames_ - 1, key, to, frame + longest_});
}

void EditSession::Refresh(int64_t from, int64_t to) {
  stale_.erase(stale_.upper_bound(from), stale_.lower_bound(to));
  std::erase_if(known_.warnings, [&](const client::Warning& warning) {
    const bool anew = warning.frame > from && warning.frame <= to;
    return anew || (from < 0 && warning.frame >= frames_);
  });
}

void EditSession::Keep(const std::vector<client::Warning>& warnings) {
  known_.warnings.insert(known_.warnings.end(), warnings.begin(), warnings.end());
}

void EditSession::FollowPath(int64_t from, int64_t to) {
  if (options_.controls.IsOption(kRootPath)) return;
  // The server warns of a path without effect.
  const bool leads =
      path_ && from < to && path_->frames.front() < to && path_->frames.back() > from;
  edit_.controls.root_path = leads ? path_ : std::nullopt;
}

void EditSession::Apply(client::EditedDance edited, const std::string& what) {
  ShowWarnings(edited.warnings, times_);
  Keep(edited.warnings);
  dance_ = std::move(edited.dance);
  std::cout << what << ": frames " << edited.first_changed << " to " << edited.end_changed - 1
            << " of " << dance_.motion.frames.size() << " are new";
  for (const client::KeyReached& key : edited.keys) {
    keys_[key.frame] = {key};
    if (&key != &edited.keys.front()) continue;  // a held pose needs only one figure
    std::cout << "; hit at " << times_.Of(key.frame) << " within "
              << Rounded(1000 * key.final_error_m) << " mm and " << Rounded(key.final_error_deg)
              << " degrees";
  }
  std::cout << std::endl;
}

}  // namespace choreo::cli
