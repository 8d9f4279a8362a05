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
#include "model/motion/canonical.h"
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
  if (!options.song.empty()) {
    const Music music = ReadMusic(options.song, Seconds(frames_), options.song_start_s);
    edit_.audio = AudioFor(music.audio, Seconds(frames_));
    edit_.music_beats = BeatsBefore(music, Seconds(frames_));
    edit_.music_passages = music.passages;
    edit_.music_id = music.id;
  }
  if (!options.report.empty()) ReadKeys();
}

void EditSession::SetKey(const std::string& source, double at_s) {
  const NamedPose named = ReadPose(source, edit_.model.skeleton);
  // Those of the library bend as bodies do.
  if (named.has_place && !options_.allow_bends)
    RefuseBends({{named.key}, {source}}, edit_.model.skeleton);
  // The very end means the last frame, as it does for keys of a new dance (dance_keys.h).
  const int64_t frame = Frame(at_s) == frames_ ? frames_ - 1 : Frame(at_s);
  if (frame >= frames_) {
    throw InvalidArgument("--at", InFull(at_s) +
                                      " s lies behind the dance, which has its last frame at " +
                                      Rounded(Seconds(frames_ - 1)) + " s");
  }
  client::KeyEdit edit;
  edit.key = named.key;
  edit.key.frame = frame;
  if (!named.has_place || options_.in_place) {
    const GroundFrame here = GroundFrame::Of(PoseAt(dance_.motion, Seconds(frame)));
    edit.key.pose = here.ToWorld(
        named.has_place ? GroundFrame::Of(named.key.pose).ToLocal(named.key.pose) : named.key.pose);
  }
  edit.from = frame == 0 ? -1 : Before(frame);
  edit.to = frame == frames_ - 1 ? frames_ : Behind(frame);
  for (const int64_t other : {edit.from, edit.to}) {
    if (other >= 0 && other < frames_)
      CheckDistance(at_s, other, keys_.contains(other) ? "the key" : "an end of the dance,");
  }
  if (const auto next = keys_.find(edit.to); next != keys_.end())
    edit.to_id = next->second["id"].get<std::string>();
  DropWarnings(edit.from, edit.to);
  WarnOfFaults(edit);
  Take(client::SetKey(client_, dance_, edit_, edit), "key " + edit.key.id);
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

void EditSession::CloseLoop() {
  const int64_t from = std::max<int64_t>(0, frames_ - 1 - Around());
  for (auto key = keys_.upper_bound(from); key != keys_.end(); key = keys_.erase(key)) {
    std::cerr << "warning: key " << key->second["id"].get<std::string>() << " at "
              << Rounded(Seconds(key->first)) << " s makes way for the loop\n";
  }
  DropWarnings(from, frames_);
  Take(client::CloseLoop(client_, dance_, edit_, from), "loop");
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
  for (const auto& key : report["keyframes"]) {
    const auto frame = key["frame"].get<int64_t>();
    if (frame >= frames_) {
      throw InvalidArgument(options_.report + ":keyframes",
                            key["id"].get<std::string>() + " stands at frame " +
                                std::to_string(frame) + ", but the dance has " +
                                std::to_string(frames_) + ": it is the report of another one");
    }
    keys_[frame] = key;
  }
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
    if (same != sources.begin()) CheckDistance(options_.at_s[i], std::prev(same)->first, "the key");
    if (std::next(same) != sources.end())
      CheckDistance(options_.at_s[i], std::next(same)->first, "the key");
  }
}

void EditSession::CheckDistance(double at_s, int64_t other, const std::string& what) const {
  const int64_t distance = std::abs(Frame(at_s) - other);
  if (distance >= kMinKeyDistance) return;
  throw InvalidArgument("--at", InFull(at_s) + " s lies " + std::to_string(distance) +
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
    std::cout << "; hit at " << Rounded(Seconds(key.frame)) << " s within "
              << Rounded(1000 * key.final_error_m) << " mm and " << Rounded(key.final_error_deg)
              << " degrees";
  }
  std::cout << std::endl;
}

}  // namespace choreo::cli
