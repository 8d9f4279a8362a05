#include "model/dance/timeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/core/error.h"
#include "model/dance/validation.h"

namespace choreo {
namespace {

std::string Frames(int64_t frames) { return std::to_string(frames); }

double FiniteSeconds(double seconds, const std::string& field) {
  if (!std::isfinite(seconds)) throw InvalidArgument(field, Show(seconds) + " s is not finite");
  return seconds;
}

}  // namespace

Timeline::Timeline(Options options)
    : options_(options), frontier_(options.first_frame), planned_to_(options.first_frame) {
  options_.max_transition_frames = std::min(options_.max_transition_frames, kMaxTransitionFrames);
  // Half the longest at most, so that what is left before a key after a cut is never shorter than
  // that.
  free_frames_ = std::clamp(options_.max_transition_frames / 2, 1, kFreeTransitionFrames);
}

int64_t Timeline::Resolve(const KeyMoment& when, const std::string& field) const {
  const double longest = kMaxDanceFrames / options_.fps;
  if (const auto* at = std::get_if<AtFrame>(&when)) {
    if (at->frame < 0 || at->frame > kMaxDanceFrames) {
      throw InvalidArgument(field + ".frame",
                            Frames(at->frame) + " is not in [0, " + Frames(kMaxDanceFrames) + "]");
    }
    return at->frame;
  }
  if (const auto* at = std::get_if<AtTime>(&when)) {
    const double seconds = FiniteSeconds(at->seconds, field + ".time");
    if (seconds < 0 || seconds > longest) {
      throw InvalidArgument(field + ".time",
                            Show(seconds) + " s is not in [0, " + Show(longest) + "]");
    }
    return std::llround(seconds * options_.fps);
  }
  const std::string path = field + ".interval_after_previous";
  const double seconds = FiniteSeconds(std::get<AfterPrevious>(when).seconds, path);
  const double limit = kMaxTransitionFrames / options_.fps;
  if (seconds <= 0 || seconds > limit) {
    throw InvalidArgument(path, Show(seconds) + " s is not in (0, " + Show(limit) + "]");
  }
  const int64_t frame = previous_frame_ + std::llround(seconds * options_.fps);
  if (frame > kMaxDanceFrames) {
    throw InvalidArgument(
        path, "leads to frame " + Frames(frame) + ", beyond the limit " + Frames(kMaxDanceFrames));
  }
  return frame;
}

void Timeline::CheckOpen(const std::string& field) const {
  if (complete_) throw InvalidArgument(field, "comes after keyframes_complete");
}

const Key* Timeline::Neighbour(int64_t frame, const std::string& except_id) const {
  for (auto it = keys_.lower_bound(frame - kMinKeyDistance + 1);
       it != keys_.end() && it->first < frame + kMinKeyDistance; ++it) {
    if (it->second.id != except_id) return &it->second;
  }
  return nullptr;
}

int64_t Timeline::EarliestFrame() const {
  int64_t frame = frontier_;
  while (const Key* key = Neighbour(frame, "")) frame = key->frame + kMinKeyDistance;
  return frame;
}

KeyRejection Timeline::Reject(const std::string& id, int64_t frame, std::string reason) {
  if (!frame_of_.contains(id) && rejected_.size() < kMaxKeys) rejected_[id] = frame;
  return {id, frame, EarliestFrame(), std::move(reason)};
}

std::optional<KeyRejection> Timeline::Set(const std::string& id, const KeyMoment& when,
                                          const Pose& pose, const PoseMask& mask,
                                          const std::string& field) {
  CheckOpen(field);
  ValidateKeyId(id, field + ".id");
  const int64_t frame = Resolve(when, field);
  if (options_.end_frame && frame >= *options_.end_frame) {
    throw InvalidArgument(
        field + ".frame",
        Frames(frame) + " is not before the end of the dance, " + Frames(*options_.end_frame));
  }
  const auto same = keys_.find(frame);
  if (same != keys_.end() && same->second.id != id) {
    throw InvalidArgument(field + ".frame",
                          Frames(frame) + " is already that of key \"" + same->second.id + '"');
  }
  const auto known = frame_of_.find(id);
  if (known != frame_of_.end() && known->second < frontier_) {
    previous_frame_ = frame;
    return Reject(id, frame,
                  "key \"" + id + "\" stands in frozen frames, at " + Frames(known->second));
  }
  if (frame < frontier_) {
    previous_frame_ = frame;
    return Reject(id, frame, "frames before " + Frames(frontier_) + " are frozen");
  }
  if (const Key* neighbour = Neighbour(frame, id)) {
    throw InvalidArgument(field + ".frame", Frames(frame) + " is closer than " +
                                                std::to_string(kMinKeyDistance) +
                                                " frames to key \"" + neighbour->id + "\" at " +
                                                Frames(neighbour->frame));
  }
  if (known == frame_of_.end() && keys_.size() >= kMaxKeys) {
    throw InvalidArgument(
        field, "is one more than the limit of " + std::to_string(kMaxKeys) + " keyframes");
  }
  if (known != frame_of_.end()) keys_.erase(known->second);
  keys_[frame] = Key{id, frame, pose, mask};
  frame_of_[id] = frame;
  rejected_.erase(id);
  previous_frame_ = frame;
  if (!explicit_grants_) frontier_ = std::max(frontier_, frame + 1);
  Plan();
  return std::nullopt;
}

std::optional<KeyRejection> Timeline::Remove(const std::string& id, const std::string& field) {
  CheckOpen(field);
  const auto known = frame_of_.find(id);
  if (known == frame_of_.end()) {
    const auto rejected = rejected_.find(id);
    if (rejected == rejected_.end()) {
      throw Error(ErrorCode::kNotFound, field + ".id", "there is no key \"" + id + '"');
    }
    return Reject(id, rejected->second, "key \"" + id + "\" was rejected before");
  }
  if (known->second < frontier_) {
    return Reject(id, known->second, "frames before " + Frames(frontier_) + " are frozen");
  }
  keys_.erase(known->second);
  frame_of_.erase(known);
  Plan();
  return std::nullopt;
}

int64_t Timeline::ControlFrom(const std::string& field) const {
  CheckOpen(field);
  return frontier_;
}

void Timeline::GenerateUntil(int64_t frame) {
  if (frame < granted_ || frame > kMaxDanceFrames) {
    throw InvalidArgument("generate_until.frame",
                          Frames(frame) + " is not in [" + Frames(granted_) + ", " +
                              Frames(kMaxDanceFrames) + "]: it may only grow");
  }
  granted_ = frame;
  // All is granted then, and with music whose end is unknown there is no last transition to plan.
  if (complete_) return;
  explicit_grants_ = true;
  frontier_ = std::max(frontier_, frame);
  Plan();
}

void Timeline::Complete() {
  CheckOpen("keyframes_complete");
  planned_at_complete_ = planned_to_;
  complete_ = true;
}

void Timeline::SetAudioEnd(int64_t frame) { audio_end_ = frame; }

Segment Timeline::Cut(int64_t to, const Key* key) {
  Segment segment{planned_to_, to, std::nullopt};
  if (key != nullptr) segment.key = *key;
  planned_to_ = to;
  return segment;
}

std::optional<Segment> Timeline::PlanOne() {
  const int64_t granted = complete_ ? std::numeric_limits<int64_t>::max() : frontier_;
  const auto ahead = keys_.lower_bound(planned_to_);
  if (ahead != keys_.end() && ahead->first + 1 - planned_to_ <= options_.max_transition_frames) {
    const int64_t to = ahead->first + 1;
    return to <= granted ? std::optional(Cut(to, &ahead->second)) : std::nullopt;
  }
  const std::optional<int64_t> end = End();
  if (end && planned_to_ >= *end) return std::nullopt;
  const int64_t to = planned_to_ + free_frames_;
  if (std::min(to, options_.end_frame.value_or(to)) > granted) return std::nullopt;
  return Cut(to, nullptr);
}

void Timeline::Plan() {
  while (auto segment = PlanOne()) planned_.push_back(std::move(*segment));
}

std::optional<Segment> Timeline::Next() {
  if (!planned_.empty()) {
    Segment segment = std::move(planned_.front());
    planned_.pop_front();
    return segment;
  }
  // Nothing can change any more, so when to plan no longer matters.
  return complete_ ? PlanOne() : std::nullopt;
}

std::optional<int64_t> Timeline::End() const {
  if (options_.end_frame) return options_.end_frame;
  if (!complete_ || (options_.has_music && !audio_end_)) return std::nullopt;
  int64_t end = options_.has_music ? *audio_end_ : planned_at_complete_;
  if (!keys_.empty()) end = std::max(end, keys_.rbegin()->first + 1);
  return std::max(end, options_.first_frame);
}

bool Timeline::Certain(int64_t frame) const {
  if (const std::optional<int64_t> end = End()) return frame < *end;
  if (!options_.has_music || !audio_end_ || frame < *audio_end_) return true;
  const auto key = keys_.lower_bound(frame);
  return key != keys_.end() && key->first < frontier_;
}

}  // namespace choreo
