// Edits phrases: all keys within a few seconds.
#include <algorithm>
#include <iostream>
#include <span>
#include <utility>

#include "client/cli/edit/edits.h"
#include "client/cli/edit/key_room.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/motion/kinematics/mirror.h"

namespace choreo::cli {
namespace {

/// The report's keys in [from_s, until_s), as danced, each with all keys that hold it. Throws if
/// there is none.
std::vector<client::KeyEdit> Phrase(const char* field, double from_s, double until_s,
                                    const WorkingDance& dance) {
  const EditedReport& report = dance.report();
  // A hold belongs to its key as a whole.
  const int64_t begin = authoring::FrameForKey(report.times().Frame(from_s)),
                from = report.AfterHold(begin),
                until = report.AfterHold(report.times().Frame(until_s));
  std::vector<client::KeyEdit> phrase;
  for (client::KeyPose& danced : dance.KeysAsDanced(from, until)) {
    if (!report.keys().at(*danced.frame).holds.empty()) {
      phrase.back().held.push_back(std::move(danced));
    } else {
      phrase.push_back({.key = std::move(danced)});
    }
  }
  if (!phrase.empty()) return phrase;
  const std::string held =
      from > begin ? ": \"" + report.keys().at(from - 1).holds + "\" is held" : std::string();
  throw InvalidArgument(field, "the report has no key from " + Rounded(from_s) + " s until " +
                                   Rounded(until_s) + " s" + held);
}

/// Shortens a hold so that it ends with the dance at the latest.
void EndWithDance(int64_t frames, client::KeyEdit* edit) {
  if (LastFrame(*edit) >= frames) HoldUntil(frames - 1, edit);
}

/// Sets the keys of a phrase at their frames, where the dance must have no other keys. `done`: what
/// the edit does to each, for people.
void SetAll(const char* field, const std::string& done, std::span<const client::KeyEdit> phrase,
            WorkingDance* dance) {
  for (const client::KeyEdit& edit : phrase) {
    const int64_t at = *edit.key.frame;
    // Generates all frames between them again.
    for (const client::KeyEdit& other : phrase)
      if (*other.key.frame != at) dance->report().MarkStale(*other.key.frame + 1);
    dance->Set(field, done, dance->times().Seconds(at), edit);
  }
  dance->report().ClearStale();
}

}  // namespace

void StretchPhrase(double from_s, double until_s, double times, WorkingDance* dance) {
  const DanceTimes& at = dance->times();
  const auto stretched = [&](int64_t frame) {
    return at.Frame(authoring::Stretched(
        at.CountedSecond(frame), at.CountedSecond(at.Frame(from_s)), times, at.counts.beats));
  };
  std::vector<client::KeyEdit> phrase = Phrase("--stretch", from_s, until_s, *dance);
  const std::vector<client::KeyEdit> unstretched = phrase;
  const size_t count = phrase.size();
  const int64_t first = *phrase.front().key.frame;
  int64_t before = -kMinKeyDistance;
  for (client::KeyEdit& edit : phrase) {
    const int64_t held_to = stretched(LastFrame(edit));
    const int64_t by = stretched(*edit.key.frame) - *edit.key.frame;
    *edit.key.frame += by;
    for (client::KeyPose& held : edit.held) *held.frame += by;
    if (!edit.held.empty()) HoldUntil(held_to, &edit);
    if (*edit.key.frame - before < kMinKeyDistance) {
      throw InvalidArgument("--stretch", InFull(times) + " sets the key \"" + edit.key.id +
                                             "\" less than " + std::to_string(kMinKeyDistance) +
                                             " frames after the one before it");
    }
    before = LastFrame(edit);
  }
  std::erase_if(phrase, [&](const client::KeyEdit& edit) { return *edit.key.frame >= at.frames; });
  if (!phrase.empty()) EndWithDance(at.frames, &phrase.back());
  // The frames generated again begin at a key that stays.
  const bool stays =
      !phrase.empty() && *phrase.front().key.frame == first && phrase.front().held.empty();
  if (phrase.size() == size_t{stays})
    throw InvalidArgument("--stretch", InFull(times) + " leaves no key in the dance that it moves");
  if (phrase.size() < count) {
    std::cerr << "note: " << count - phrase.size() << " of " << count
              << " keys would fall after the end of the dance, and are left out\n";
  }
  const int64_t now = *phrase.front().key.frame, last = LastFrame(phrase.back());
  EditedReport& report = dance->report();
  // The hold of a key before the phrase.
  const std::vector<client::Warning> ended =
      now < first ? EndHold(now, phrase.front().key.id, &report) : std::vector<client::Warning>();
  ClearWay(
      stays ? first + 1 : std::min(first, now - kMinKeyDistance + 1),
      std::max({at.Frame(until_s), stretched(at.Frame(until_s)), last + int64_t{kMinKeyDistance}}),
      unstretched, "stretched keys", &report);
  SetAll("--stretch", "stretched", std::span(phrase).subspan(size_t{stays}), dance);
  report.Keep(ended);
}

void RepeatPhrase(double from_s, double until_s, const std::string& later, WorkingDance* dance) {
  const DanceTimes& times = dance->times();
  const authoring::WrittenTime delay = authoring::ParseTime(later, "--repeat");
  const auto moved = [&](int64_t frame) {
    const double second = delay.counts ? times.CountedSecond(frame) : times.Seconds(frame);
    return times.Frame(delay.After(second, times.counts, "--repeat"));
  };
  const int64_t from = times.Frame(from_s);
  if (moved(from) <= from)
    throw InvalidArgument("--repeat", later + " is not later: it must be at least one frame");
  std::vector<client::KeyEdit> phrase = Phrase("--repeat", from_s, until_s, *dance);
  for (client::KeyEdit& edit : phrase) {
    edit.key.frame = times.KeyFrame("--repeat", times.Seconds(moved(*edit.key.frame)));
    for (client::KeyPose& held : edit.held) held.frame = moved(*held.frame);
  }
  EndWithDance(times.frames, &phrase.back());
  const int64_t first = *phrase.front().key.frame;
  const GroundFrame there = GroundFrame::Of(phrase.front().key.pose);
  const GroundFrame here = dance->Here(first);
  const auto carry = [&](Pose& pose) { pose = here.ToWorld(there.ToLocal(pose)); };
  // Removes the keys at the phrase's new place, and those too near to it.
  EditedReport& report = dance->report();
  const std::vector<client::Warning> ended = EndHold(first, phrase.front().key.id, &report);
  const int64_t last = LastFrame(phrase.back());
  ClearWay(std::min(moved(from), first - kMinKeyDistance + 1),
           std::max(moved(times.Frame(until_s)), last + kMinKeyDistance), {}, "repeated keys",
           &report);
  for (client::KeyEdit& edit : phrase) {
    carry(edit.key.pose);
    for (client::KeyPose& held : edit.held) carry(held.pose);
  }
  SetAll("--repeat", "repeated", phrase, dance);
  report.Keep(ended);
}

void MirrorPhrase(double from_s, double until_s, WorkingDance* dance) {
  constexpr const char* kField = "--mirror-phrase";
  std::vector<client::KeyEdit> phrase = Phrase(kField, from_s, until_s, *dance);
  const GroundFrame axis = GroundFrame::Of(phrase.front().key.pose);
  const auto mirror = [&](Pose& pose) {
    pose = axis.ToWorld(Mirror(dance->settings().model.skeleton, axis.ToLocal(pose)));
  };
  for (client::KeyEdit& edit : phrase) {
    mirror(edit.key.pose);
    for (client::KeyPose& held : edit.held) mirror(held.pose);
    dance->report().Forget(*edit.key.frame, LastFrame(edit) + 1);
  }
  SetAll(kField, "mirrored", phrase, dance);
}

}  // namespace choreo::cli
