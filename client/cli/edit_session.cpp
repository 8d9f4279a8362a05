#include "client/cli/edit_session.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "client/cli/key_faults.h"
#include "client/cli/motion_input.h"
#include "client/cli/music.h"
#include "client/cli/options.h"
#include "client/cli/output_file.h"
#include "client/cli/pose_source.h"
#include "client/cli/report.h"
#include "model/core/atomic_file.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"
#include "model/formats/npz.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

constexpr double kAround = 2;  // seconds, where nothing says how far an edit may reach

client::FinishedDance ReadDance(const std::filesystem::path& path, const Skeleton& skeleton) {
  client::FinishedDance dance;
  // A retargeted dance would not be the one that was to stay as it is.
  dance.motion = ReadMotionNoting(path, skeleton, OtherSkeleton::kRefuse);
  if (SmallExtension(path) != ".npz") return dance;
  const NpzArchive npz = NpzArchive::Read(path);
  if (!npz.Has("contacts")) return dance;
  const NpyArray array = npz.Array("contacts");
  if (array.shape != std::vector{static_cast<int64_t>(dance.motion.frames.size()), int64_t{4}}) {
    throw InvalidArgument(path.string() + ":contacts",
                          "has not four values for each of the " +
                              std::to_string(dance.motion.frames.size()) + " frames");
  }
  const std::vector<float> values = array.As<float>();
  dance.contacts.resize(dance.motion.frames.size());
  for (size_t i = 0; i < values.size(); ++i) dance.contacts[i / 4][i % 4] = values[i];
  return dance;
}

}  // namespace

EditSession::EditSession(const EditOptions& options, const Connection& connection)
    : options_(options), client_(connection.client()) {
  edit_.model = connection.model(options.model);
  edit_.seed = options.seed.value_or(0);
  edit_.temperature = options.temperature;
  edit_.music_dynamics = options.music_dynamics;
  edit_.variation = options.variation;
  edit_.style = options.style;
  edit_.controls = options.controls.Read(edit_.model, connection.server());
  NoteDeterministic(edit_.model, {{"--seed", options.seed.has_value()},
                                  {"--temperature", edit_.temperature.value_or(0) != 0}});
  longest_ = edit_.model.max_transition_frames - 1;
  if (options.around_s) CheckAround(*options.around_s);
  CheckKeys();
  dance_ = ReadDance(options.dance, edit_.model.skeleton);
  frames_ = CountModelFrames(dance_, edit_.model);
  options.controls.RequireBegun(edit_.controls, {frames_, edit_.model.fps});
  if (!options.report.empty()) ReadKeys();
  if (!options.song.empty()) {
    const double end_s = Seconds(frames_ + (options.loop ? LoopFrames().added : 0));
    const Music music = ReadMusic(options.song, end_s, options.song_start_s);
    edit_.audio = AudioFor(music.audio, end_s);
    edit_.music_beats = BeatsBefore(music, end_s);
    edit_.music_passages = music.passages;
    edit_.music_id = music.id;
  }
}

void EditSession::SetKey(const std::string& source, double at_s) {
  const NamedPose named = ReadPose(source, edit_.model.skeleton);
  // Those of the library bend as bodies do.
  if (named.has_place && !options_.allow_bends)
    RefuseBends({{named.key}, {source}}, edit_.model.skeleton);
  client::KeyEdit edit;
  edit.key = named.key;
  edit.key.frame = FrameInDance("--at", at_s);
  Pose& pose = edit.key.pose;
  if (!named.has_place)
    pose = Here(*edit.key.frame).ToWorld(pose);
  else if (options_.in_place)
    pose = Here(*edit.key.frame).ToWorld(GroundFrame::Of(pose).ToLocal(pose));
  Set("--at", at_s, std::move(edit));
}

void EditSession::RemoveKey(const std::string& id) {
  const std::vector<int64_t> frames = FindKey(keys_, id, edit_.model.fps, "--remove");
  if (frames.front() == 0) {
    throw InvalidArgument("--remove", "\"" + IdAt(0) +
                                          "\" is the first frame, where the dance begins; set "
                                          "another key there instead: --key POSE --at 0");
  }
  Free(frames, "removed " + IdAt(frames.front()));
}

void EditSession::MoveKey(const std::string& id, double to_s) {
  const std::vector<int64_t> frames = FindKey(keys_, id, edit_.model.fps, "--move");
  const int64_t by = FrameInDance("--move", to_s) - frames.front();
  if (frames.front() == 0 && by != 0) {
    throw InvalidArgument("--move", "\"" + IdAt(0) +
                                        "\" is the first frame, where the dance begins; set it at "
                                        "another second with --key");
  }
  if (frames.back() + by >= frames_) {
    throw InvalidArgument("--move", InFull(to_s) + " s: its pose would be held up to " +
                                        Rounded(Seconds(frames.back() + by)) +
                                        " s, and the dance has its last frame at " +
                                        Rounded(Seconds(frames_ - 1)) + " s");
  }
  client::KeyEdit edit;
  for (const int64_t frame : frames) {
    client::KeyPose& key = frame == frames.front() ? edit.key : edit.held.emplace_back();
    key.id = IdAt(frame);
    key.pose = PoseAt(dance_.motion, Seconds(frame));
    key.frame = frame + by;
    if (options_.in_place)
      key.pose = Here(frames.front() + by).ToWorld(Here(frames.front()).ToLocal(key.pose));
  }
  for (const int64_t frame : frames) keys_.erase(frame);
  const auto other = keys_.upper_bound(frames.front() + by);
  if (other != keys_.end() && other->first <= frames.back() + by) {
    throw InvalidArgument("--move", InFull(to_s) + " s: its pose would be held over the key \"" +
                                        IdAt(other->first) + "\" at " +
                                        Rounded(Seconds(other->first)) + " s");
  }
  // What is danced anew around its new place may not reach the old one.
  const auto is_new = [&](int64_t frame) {
    return frame > Before(frames.front() + by) && frame < Behind(frames.back() + by);
  };
  if (!std::ranges::all_of(frames, is_new)) Free(frames, edit.key.id + " leaves its place");
  const std::string held = edit.key.id;
  Set("--move", to_s, std::move(edit));
  for (size_t i = 1; i < frames.size(); ++i) MarkHeld(held, &keys_[frames[i] + by]);
}

void EditSession::Set(const char* field, double at_s, client::KeyEdit edit) {
  const int64_t first = *edit.key.frame;
  const int64_t last = edit.held.empty() ? first : *edit.held.back().frame;
  edit.from = first == 0 ? -1 : Before(first);
  edit.to = last == frames_ - 1 ? frames_ : Behind(last);
  for (const auto& [frame, other] : {std::pair(first, edit.from), {last, edit.to}}) {
    if (other < 0 || other >= frames_) continue;
    CheckDistance(field, at_s + Seconds(frame - first), other,
                  keys_.contains(other) ? "the key" : "an end of the dance,");
  }
  if (keys_.contains(edit.to)) edit.to_id = IdAt(edit.to);
  DropWarnings(edit.from, edit.to);
  WarnOfFaults(edit);
  Take(client::SetKey(client_, dance_, edit_, edit), "key " + edit.key.id);
}

void EditSession::Free(const std::vector<int64_t>& frames, const std::string& what) {
  for (const int64_t frame : frames) keys_.erase(frame);
  client::Gap gap{.from = Before(frames.front()),
                  .to = frames.back() == frames_ - 1 ? frames_ : Behind(frames.back())};
  if (keys_.contains(gap.to)) gap.to_id = IdAt(gap.to);
  if (gap.to - gap.from > longest_) {
    throw InvalidArgument("--around", "without the key " + Rounded(Seconds(gap.to - gap.from)) +
                                          " s are danced at once, the model's most are " +
                                          Rounded(Seconds(longest_)) +
                                          " s: say how much is to be danced anew");
  }
  DropWarnings(gap.from, gap.to);
  Take(client::DanceFreely(client_, dance_, edit_, gap), what);
}

void EditSession::WarnOfFaults(const client::KeyEdit& edit) {
  std::vector<TimedPose> around;
  for (const int64_t frame : {edit.from, edit.to}) {
    if (frame < 0 || frame >= frames_) continue;
    around.push_back(
        {Rounded(Seconds(frame)) + " s", Seconds(frame), PoseAt(dance_.motion, Seconds(frame))});
  }
  const auto faults = KeyFaults(edit.key, edit_.model.fps, edit_.model.skeleton, around);
  ShowWarnings(faults);
  warnings_.insert(warnings_.end(), faults.begin(), faults.end());
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
    std::cerr << "warning: key " << key->second["id"].get<std::string>() << " at "
              << Rounded(Seconds(key->first)) << " s makes way for the loop\n";
  }
  if (added > 0) {
    std::cerr << "note: the pose that is held at the end stays; the way back makes the dance "
              << Rounded(Seconds(added)) << " s longer\n";
  }
  DropWarnings(from, frames_);
  frames_ += added;
  Take(client::CloseLoop(client_, dance_, edit_, from, added), "loop");
}

void EditSession::Write() const {
  WriteMotion(options_.out, edit_.model.skeleton, dance_.motion,
              dance_.contacts.empty() ? nullptr : &dance_.contacts);
  std::cout << options_.out << std::endl;
  if (options_.new_report.empty()) return;
  // Of the old report, only what still holds.
  nlohmann::ordered_json report = {{"frames", frames_}, {"fps", edit_.model.fps}};
  report["keyframes"] = nlohmann::ordered_json::array();
  for (const auto& [frame, key] : keys_) report["keyframes"].push_back(key);
  report["warnings"] = WarningsJson(warnings_);
  WriteFile(options_.new_report, report.dump(2) + "\n");
}

void EditSession::ReadKeys() {
  const auto report = ReadReport(options_.report);
  if (report["fps"] != edit_.model.fps) {
    std::ostringstream message;
    message << report["fps"].dump() << ", but the model runs at " << edit_.model.fps;
    throw InvalidArgument(options_.report + ":fps", message.str());
  }
  keys_ = KeysOf(report, frames_, options_.report);
  warnings_ = ReadWarnings(report, options_.report);
}

void EditSession::CheckKeys() const {
  std::map<int64_t, std::string> sources;  // by frame
  for (size_t i = 0; i < options_.keys.size(); ++i) {
    const auto [same, is_new] = sources.emplace(Frame(options_.at_s[i]), options_.keys[i]);
    if (!is_new) {
      throw InvalidArgument("--key", same->second + " and " + options_.keys[i] +
                                         " both ask for frame " + std::to_string(same->first));
    }
    const double at_s = options_.at_s[i];
    if (same != sources.begin()) CheckDistance("--at", at_s, std::prev(same)->first, "the key");
    if (std::next(same) != sources.end())
      CheckDistance("--at", at_s, std::next(same)->first, "the key");
  }
}

int64_t EditSession::FrameInDance(const char* field, double at_s) const {
  // The very end means the last frame, as it does for keys of a new dance (dance_keys.h).
  const int64_t frame = Frame(at_s) == frames_ ? frames_ - 1 : Frame(at_s);
  if (frame < frames_) return frame;
  throw InvalidArgument(field, InFull(at_s) +
                                   " s lies behind the dance, which has its last frame at " +
                                   Rounded(Seconds(frames_ - 1)) + " s");
}

GroundFrame EditSession::Here(int64_t frame) const {
  return GroundFrame::Of(PoseAt(dance_.motion, Seconds(frame)));
}

void EditSession::CheckDistance(const char* field, double at_s, int64_t other,
                                const std::string& what) const {
  const int64_t distance = std::abs(Frame(at_s) - other);
  if (distance >= kMinKeyDistance) return;
  throw InvalidArgument(field, InFull(at_s) + " s lies " + std::to_string(distance) +
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
  return std::min(longest_, static_cast<int64_t>(std::llround(options_.around_s.value_or(kAround) *
                                                              edit_.model.fps)));
}

int64_t EditSession::Reach() const {
  return options_.around_s || options_.report.empty() ? Around() : longest_;
}

int64_t EditSession::Before(int64_t frame) const {
  const auto next = keys_.lower_bound(frame);
  const int64_t key = next == keys_.begin() ? 0 : std::prev(next)->first;
  return std::max({int64_t{0}, key, frame - Reach()});
}

int64_t EditSession::Behind(int64_t frame) const {
  const auto next = keys_.upper_bound(frame);
  const int64_t key = next == keys_.end() ? frames_ - 1 : next->first;
  return std::min({frames_ - 1, key, frame + Reach()});
}

void EditSession::DropWarnings(int64_t from, int64_t to) {
  std::erase_if(warnings_, [&](const client::Warning& warning) {
    const bool anew = warning.frame > from && warning.frame <= to;
    return anew || (from < 0 && warning.frame >= frames_);
  });
}

void EditSession::Take(client::EditedDance edited, const std::string& what) {
  ShowWarnings(edited.warnings);
  warnings_.insert(warnings_.end(), edited.warnings.begin(), edited.warnings.end());
  dance_ = std::move(edited.dance);
  std::cout << what << ": frames " << edited.first_changed << " to " << edited.end_changed - 1
            << " of " << dance_.motion.frames.size() << " are new";
  for (const client::KeyReached& key : edited.keys) {
    keys_[key.frame] = KeyJson(key);
    if (&key != &edited.keys.front()) continue;  // of a pose that is held one figure is enough
    std::cout << "; hit at " << Rounded(Seconds(key.frame)) << " s within "
              << Rounded(1000 * key.final_error_m) << " mm and " << Rounded(key.final_error_deg)
              << " degrees";
  }
  std::cout << std::endl;
}

}  // namespace choreo::cli
