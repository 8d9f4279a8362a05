// Edits single keys.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <utility>

#include "client/authoring/keys/ending.h"
#include "client/authoring/keys/key_faults.h"
#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_library.h"
#include "client/authoring/keys/pose_source.h"
#include "client/cli/edit/edits.h"
#include "client/cli/edit/key_room.h"

namespace choreo::cli {
namespace {

/// Reads a pose as --key names it: that of a key of the report, around the origin, or a source
/// for ReadPose. A pose of the library goes before a key of the same name, as does a file.
authoring::NamedPose ReadKeyPose(const std::string& source, const WorkingDance& dance) {
  const ReportKeys& keys = dance.report().keys();
  const DanceTimes& times = dance.times();
  const bool is_key = std::ranges::any_of(keys, [&](const auto& key) {
    return source == key.second.id || source.starts_with(key.second.id + '@');
  });
  if (!is_key || std::filesystem::exists(authoring::FileOf(source)) ||
      std::ranges::find(authoring::PoseLibrary(), source, &authoring::LibraryPose::id) !=
          authoring::PoseLibrary().end())
    return authoring::ReadPose(source, dance.settings().model.skeleton, times.counts);
  const std::vector<int64_t> frames = FindKey(keys, source, times.fps, "--key", times.counts);
  const GroundFrame there = dance.Here(frames.front());
  authoring::NamedPose named;
  named.has_place = false;
  for (client::KeyPose& key : dance.KeysAsDanced(frames.front(), frames.back() + 1)) {
    key.time_s = times.Seconds(*key.frame);
    key.frame.reset();
    key.pose = there.ToLocal(key.pose);
    (named.key.id.empty() ? named.key : named.held.emplace_back()) = std::move(key);
  }
  std::cerr << "note: \"" << named.key.id << "\" is the report's key at "
            << times.format.Of(frames.front()) << "; its pose is set where the dancer is\n";
  return named;
}

/// Holds a key at second `at_s` for the time of --hold or, without it, as long as it is held now.
/// `source`: the key's name in errors.
void HoldAsAsked(const EditOptions& options, const std::string& source, double at_s,
                 const WorkingDance& dance, client::KeyEdit* edit) {
  client::KeyPose& key = edit->key;
  if (!options.hold.empty()) {
    const double until_s =
        authoring::ParseTime(options.hold, "--hold").After(at_s, dance.times().counts, "--hold");
    edit->held = authoring::Holding(&key, until_s - at_s, "--hold");
  }
  if (edit->held.empty()) return;
  authoring::RefuseHeldInAir(key, edit->held.back().time_s - key.time_s,
                             options.hold.empty() ? source : "--hold",
                             dance.settings().model.skeleton);
  for (client::KeyPose& held : edit->held) {
    held.frame = dance.times().Frame(at_s + held.time_s - key.time_s);
    held.pose = key.pose;
    held.hands = key.hands;
  }
}

}  // namespace

void CheckKeys(const EditOptions& options, const DanceTimes& times) {
  std::map<int64_t, std::string> sources;  // by frame
  for (size_t i = 0; i < options.keys.size(); ++i) {
    const double at_s = times.Second("--at", options.at[i]);
    const auto [same, is_new] = sources.emplace(times.Frame(at_s), options.keys[i]);
    if (!is_new) {
      throw InvalidArgument("--key", same->second + " and " + options.keys[i] + " both ask for " +
                                         times.format.Of(same->first));
    }
    if (same != sources.begin())
      CheckDistance(times, "--at", at_s, std::prev(same)->first, "the key");
    if (std::next(same) != sources.end())
      CheckDistance(times, "--at", at_s, std::next(same)->first, "the key");
  }
}

void RemoveKey(const std::string& id, WorkingDance* dance) {
  const EditedReport& report = dance->report();
  const std::vector<int64_t> frames =
      FindKey(report.keys(), id, report.times().fps, "--remove", report.times().counts);
  if (frames.front() == 0) {
    throw InvalidArgument("--remove", "\"" + report.IdAt(0) +
                                          "\" is the first frame, where the dance begins; set "
                                          "another key there instead: --key POSE --at 0");
  }
  dance->Free(frames, "removed " + report.IdAt(frames.front()));
}

void MoveKey(const EditOptions& options, const std::string& id, double to_s, WorkingDance* dance) {
  EditedReport& report = dance->report();
  const EditReach& reach = dance->reach();
  const std::vector<int64_t> frames =
      FindKey(report.keys(), id, report.times().fps, "--move", report.times().counts);
  const int64_t by = report.times().KeyFrame("--move", to_s) - frames.front();
  if (frames.front() == 0 && by != 0) {
    throw InvalidArgument("--move", "\"" + report.IdAt(0) +
                                        "\" is the first frame, where the dance begins; set it at "
                                        "another second with --key");
  }
  client::KeyEdit edit;
  for (client::KeyPose& key : dance->KeysAsDanced(frames.front(), frames.back() + 1)) {
    const bool holds = *key.frame != frames.front();
    *key.frame += by;
    if (!options.hands.empty()) key.hands = FindHandPose(options.hands);
    if (options.in_place)
      key.pose =
          dance->Here(frames.front() + by).ToWorld(dance->Here(frames.front()).ToLocal(key.pose));
    (holds ? edit.held.emplace_back() : edit.key) = std::move(key);
  }
  if (options.hit) edit.key.hit = options.hit;
  if (!options.hold.empty()) HoldAsAsked(options, edit.key.id, to_s, *dance, &edit);
  report.Forget(frames.front(), frames.back() + 1);
  const std::vector<client::Warning> ended = MakeRoom("--move", &edit, &report);
  // The frames generated again around the new place may not include the old one.
  const auto is_new = [&](int64_t frame) {
    return frame > reach.Before(report, frames.front() + by) &&
           frame < reach.After(report, LastFrame(edit));
  };
  if (!reach.Reaches(std::abs(by)) || !std::ranges::all_of(frames, is_new))
    dance->Free(frames, edit.key.id + " leaves its place");
  dance->Set("--move", "moved", to_s, std::move(edit));
  report.Keep(ended);
}

void SetKey(const EditOptions& options, const std::string& source, double at_s,
            WorkingDance* dance) {
  const authoring::NamedPose named = ReadKeyPose(source, *dance);
  // The library's poses are known to bend correctly.
  if (named.has_place && !options.allow_bends)
    authoring::RefuseBends({{named.key}, {source}}, dance->settings().model.skeleton);
  client::KeyEdit edit{.key = named.key, .held = named.held};
  edit.key.frame = dance->times().KeyFrame("--at", at_s);
  const GroundFrame here = dance->Here(*edit.key.frame);
  Pose& pose = edit.key.pose;
  if (!named.has_place) {
    pose = options.placing.From(here).ToWorld(pose);
  } else {
    if (options.in_place) pose = here.ToWorld(GroundFrame::Of(pose).ToLocal(pose));
    authoring::PlaceRoot(options.placing, "--place", &edit.key);
  }
  if (!options.hands.empty()) edit.key.hands = FindHandPose(options.hands);
  if (options.hit) edit.key.hit = options.hit;
  HoldAsAsked(options, source, at_s, *dance, &edit);
  const std::vector<client::Warning> ended = MakeRoom("--at", &edit, &dance->report());
  dance->Set("--at", "set", at_s, std::move(edit));
  dance->report().Keep(ended);
}

void EndInPose(const EditOptions& options, const std::string& source, WorkingDance* dance) {
  const DanceTimes& times = dance->times();
  const Skeleton& skeleton = dance->settings().model.skeleton;
  const authoring::NamedPose named = authoring::ReadPose(source, skeleton, times.counts);
  if (named.has_place && !options.allow_bends)
    authoring::RefuseBends({{named.key}, {source}}, skeleton);
  authoring::NoteOwnHold(named);
  const double last_s = times.Seconds(times.frames - 1);
  client::KeyEdit edit;
  edit.key = authoring::Ending(named, times.counts.beats, {times.frames, times.fps});
  const double begin_s = edit.key.time_s;
  const int64_t begin = *edit.key.frame;
  if (!named.has_place)
    edit.key.pose = GroundFrame{.origin = dance->Here(begin).origin}.ToWorld(named.key.pose);
  authoring::RefuseHeldInAir(named.key, last_s - begin_s, "--end", skeleton);
  edit.held = authoring::Holding(&edit.key, last_s - begin_s, "--end");
  for (client::KeyPose& held : edit.held) held.frame = times.Frame(held.time_s);
  // Ends a hold that reaches into the transition to the pose.
  EditedReport& report = dance->report();
  const std::vector<client::Warning> ended = EndHold(begin, edit.key.id, &report);
  ClearWay(begin - times.Frame(authoring::kWayFromHold) + 1, times.frames, {}, "the ending",
           &report);
  dance->Set("--end", "set", begin_s, std::move(edit));
  report.Keep(ended);
}

}  // namespace choreo::cli
