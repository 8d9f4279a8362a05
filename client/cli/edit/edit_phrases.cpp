// Edits phrases: all keys within a few seconds.
#include <algorithm>
#include <iostream>
#include <set>
#include <utility>

#include "client/cli/edit/edit_session.h"
#include "client/cli/report/report.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/motion/mirror.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

/// Holds a key until a frame, with keys as close together as those that held it for `before`
/// frames.
void HoldUntil(int64_t last, int64_t before, client::KeyEdit* edit) {
  const int64_t frames = last - *edit->key.frame;
  const auto count = static_cast<int64_t>(edit->held.size());
  const int64_t needed = frames < kMinKeyDistance ? 0 : (frames * count + before / 2) / before;
  edit->held.resize(static_cast<size_t>(needed), edit->held.front());
  for (int64_t i = 0; i < needed; ++i)
    edit->held[static_cast<size_t>(i)].frame = *edit->key.frame + frames * (i + 1) / needed;
}

}  // namespace

void HoldUntil(int64_t last, client::KeyEdit* edit) {
  HoldUntil(last, LastFrame(*edit) - *edit->key.frame, edit);
}

void EditSession::Repeat(double from_s, double until_s, const std::string& later) {
  const authoring::WrittenTime delay = authoring::ParseTime(later, "--repeat");
  const auto moved = [&](int64_t frame) {
    const double second = delay.counts ? CountedSecond(frame) : Seconds(frame);
    return Frame(delay.After(second, counts_, "--repeat"));
  };
  if (moved(Frame(from_s)) <= Frame(from_s))
    throw InvalidArgument("--repeat", later + " is not later: it must be at least one frame");
  std::vector<client::KeyEdit> phrase = Phrase("--repeat", from_s, until_s);
  for (client::KeyEdit& edit : phrase) {
    edit.key.frame = FrameInDance("--repeat", Seconds(moved(*edit.key.frame)));
    for (client::KeyPose& held : edit.held) held.frame = moved(*held.frame);
  }
  EndWithDance(&phrase.back());
  const int64_t first = *phrase.front().key.frame;
  const GroundFrame there = GroundFrame::Of(phrase.front().key.pose);
  const GroundFrame here = Here(first);
  const auto carry = [&](Pose& pose) { pose = here.ToWorld(there.ToLocal(pose)); };
  // Removes the keys at the phrase's new place, and those too near to it.
  const std::vector<client::Warning> ended = EndHold(first, phrase.front().key.id);
  const int64_t last = LastFrame(phrase.back());
  ClearWay(std::min(moved(Frame(from_s)), first - kMinKeyDistance + 1),
           std::max(moved(Frame(until_s)), last + kMinKeyDistance), {}, "repeated keys");
  for (client::KeyEdit& edit : phrase) {
    carry(edit.key.pose);
    for (client::KeyPose& held : edit.held) carry(held.pose);
  }
  SetAll("--repeat", phrase);
  Keep(ended);
}

void EditSession::MirrorPhrase(double from_s, double until_s) {
  constexpr const char* kField = "--mirror-phrase";
  std::vector<client::KeyEdit> phrase = Phrase(kField, from_s, until_s);
  const GroundFrame axis = GroundFrame::Of(phrase.front().key.pose);
  const auto mirror = [&](Pose& pose) {
    pose = axis.ToWorld(Mirror(edit_.model.skeleton, axis.ToLocal(pose)));
  };
  for (client::KeyEdit& edit : phrase) {
    mirror(edit.key.pose);
    for (client::KeyPose& held : edit.held) mirror(held.pose);
    Forget(keys_.find(*edit.key.frame), keys_.upper_bound(LastFrame(edit)));
  }
  SetAll(kField, phrase);
}

void EditSession::SetAll(const char* field, std::span<client::KeyEdit> phrase) {
  std::vector<int64_t> frames;
  for (const client::KeyEdit& edit : phrase) frames.push_back(*edit.key.frame);
  for (client::KeyEdit& edit : phrase) {
    const int64_t at = *edit.key.frame;
    // Generates all frames between them again.
    for (const int64_t frame : frames)
      if (frame != at) stale_.insert(frame + 1);
    Set(field, Seconds(at), std::move(edit));
  }
  stale_.clear();
}

void EditSession::EndWithDance(client::KeyEdit* edit) const {
  if (LastFrame(*edit) >= frames_) HoldUntil(frames_ - 1, edit);
}

int64_t EditSession::AfterHold(int64_t frame) const {
  auto key = keys_.lower_bound(frame);
  for (; key != keys_.end() && !key->second.holds.empty(); ++key) frame = key->first + 1;
  return frame;
}

std::vector<client::KeyPose> EditSession::KeysAsDanced(int64_t first, int64_t end) const {
  std::vector<client::KeyPose> danced;
  for (auto key = keys_.lower_bound(first); key != keys_.end() && key->first < end; ++key) {
    danced.push_back({.id = IdAt(key->first),
                      .frame = key->first,
                      .pose = PoseAt(dance_.motion, Seconds(key->first)),
                      .hit = key->second.hit,
                      .hands = key->second.hands});
  }
  return danced;
}

std::vector<client::KeyEdit> EditSession::Phrase(const char* field, double from_s,
                                                 double until_s) const {
  // A hold belongs to its key as a whole.
  const int64_t from = AfterHold(Frame(from_s)), until = AfterHold(Frame(until_s));
  std::vector<client::KeyEdit> phrase;
  for (client::KeyPose& danced : KeysAsDanced(from, until)) {
    if (!keys_.at(*danced.frame).holds.empty()) {
      phrase.back().held.push_back(std::move(danced));
    } else {
      phrase.push_back({.key = std::move(danced)});
    }
  }
  if (!phrase.empty()) return phrase;
  const std::string held =
      from > Frame(from_s) ? ": \"" + keys_.at(from - 1).holds + "\" is held" : std::string();
  throw InvalidArgument(field, "the report has no key from " + Rounded(from_s) + " s until " +
                                   Rounded(until_s) + " s" + held);
}

void EditSession::Stretch(double from_s, double until_s, double times) {
  const auto stretched = [&](int64_t frame) {
    return Frame(authoring::Stretched(CountedSecond(frame), CountedSecond(Frame(from_s)), times,
                                      counts_.beats));
  };
  std::vector<client::KeyEdit> phrase = Phrase("--stretch", from_s, until_s);
  const std::vector<client::KeyEdit> unstretched = phrase;
  const size_t count = phrase.size();
  const int64_t first = *phrase.front().key.frame;
  int64_t before = -kMinKeyDistance;
  for (client::KeyEdit& edit : phrase) {
    const int64_t held_to = stretched(LastFrame(edit));
    const int64_t old = std::exchange(*edit.key.frame, stretched(*edit.key.frame));
    if (!edit.held.empty()) HoldUntil(held_to, LastFrame(edit) - old, &edit);
    if (*edit.key.frame - before < kMinKeyDistance) {
      throw InvalidArgument("--stretch", InFull(times) + " sets the key \"" + edit.key.id +
                                             "\" less than " + std::to_string(kMinKeyDistance) +
                                             " frames after the one before it");
    }
    before = LastFrame(edit);
  }
  std::erase_if(phrase, [&](const client::KeyEdit& edit) { return *edit.key.frame >= frames_; });
  if (!phrase.empty()) EndWithDance(&phrase.back());
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
  // The hold of a key before the phrase.
  const std::vector<client::Warning> ended =
      now < first ? EndHold(now, phrase.front().key.id) : std::vector<client::Warning>();
  ClearWay(stays ? first + 1 : std::min(first, now - kMinKeyDistance + 1),
           std::max({Frame(until_s), stretched(Frame(until_s)), last + int64_t{kMinKeyDistance}}),
           unstretched, "stretched keys");
  SetAll("--stretch", std::span(phrase).subspan(size_t{stays}));
  Keep(ended);
}

void EditSession::ClearWay(int64_t first, int64_t end, const std::vector<client::KeyEdit>& moved,
                           const std::string& what) {
  std::set<int64_t> leave;
  for (const client::KeyEdit& edit : moved) leave.insert(*edit.key.frame);
  const auto begin = keys_.lower_bound(AfterHold(first));
  const auto stop = keys_.lower_bound(AfterHold(end));
  for (auto key = begin; key != stop; ++key) {
    // Prints one line for a held pose and all keys that hold it.
    if (!leave.contains(key->first) && key->second.holds.empty()) NoteWay(key->first, what);
  }
  Forget(begin, stop);
}

}  // namespace choreo::cli
