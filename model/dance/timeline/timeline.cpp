#include "model/dance/timeline/timeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/core/error.h"
#include "model/dance/timeline/validation.h"

namespace choreo {
namespace {

constexpr double kMinCut_s = 0.5;
constexpr int64_t kNever = std::numeric_limits<int64_t>::max();
constexpr int64_t kNoFrame = -1;

std::string Frames(int64_t frames) { return std::to_string(frames); }

bool AreDancedAlike(const std::optional<Key>& a, const std::optional<Key>& b) {
  return a && b ? a->IsDancedAs(*b) : !a && !b;
}
bool AreEqual(const std::optional<Key>& a, const std::optional<Key>& b) {
  return AreDancedAlike(a, b) && (!a || a->hands == b->hands);
}

double FiniteSeconds(double seconds, const std::string& field) {
  if (!std::isfinite(seconds)) throw InvalidArgument(field, Show(seconds) + " s is not finite");
  return seconds;
}

/// The path of a moment, for errors.
std::string PathOf(const KeyMoment& when, const std::string& field) {
  static constexpr const char* kMembers[] = {".at_frame", ".at_time", ".after_previous"};
  return field + kMembers[when.index()];
}

}  // namespace

int64_t TransitionEnd(int64_t from, std::optional<int64_t> next_key, int longest) {
  if (next_key && *next_key + 1 - from <= longest) return *next_key + 1;
  return from + std::clamp(longest / 2, 1, kTypicalFrames);
}

int LongestToKey(int max_transition_frames, int sight_frames) {
  return sight_frames > 0 ? std::min(max_transition_frames, 2 * kTypicalFrames)
                          : max_transition_frames;
}

Timeline::Timeline(Options options)
    : options_(options), changed_from_(kNever), danced_to_(options.first_frame) {
  options_.max_transition_frames = std::min(options_.max_transition_frames, kMaxTransitionFrames);
  if (options_.granted) GenerateUntil(*options_.granted);
}

int64_t Timeline::Resolve(const KeyMoment& when, const std::string& field) const {
  const double longest = kMaxDanceFrames / options_.fps;
  const std::string path = PathOf(when, field);
  if (const auto* at = std::get_if<AtFrame>(&when))
    return CheckedIn(at->frame, 0, kMaxDanceFrames, path);
  if (const auto* at = std::get_if<AtTime>(&when)) {
    const double seconds = FiniteSeconds(at->seconds, path);
    if (seconds < 0 || seconds > longest) {
      throw InvalidArgument(path, Show(seconds) + " s is not in [0, " + Show(longest) + "]");
    }
    return std::llround(seconds * options_.fps);
  }
  const int64_t frame = previous_frame_ + CheckedIn(std::get<AfterPrevious>(when).frames,
                                                    kMinKeyDistance, kMaxDanceFrames, path);
  if (frame > kMaxDanceFrames) {
    throw InvalidArgument(
        path, "leads to frame " + Frames(frame) + ", beyond the limit " + Frames(kMaxDanceFrames));
  }
  return frame;
}

void Timeline::CheckOpen(const std::string& field) const {
  if (complete_) throw InvalidArgument(field, "comes after the keys are complete");
}

const Key* Timeline::Neighbour(int64_t frame, const std::string& except_id) const {
  for (auto it = keys_.lower_bound(frame - kMinKeyDistance + 1);
       it != keys_.end() && it->first < frame + kMinKeyDistance; ++it) {
    if (it->second.id != except_id) return &it->second;
  }
  return nullptr;
}

int64_t Timeline::EarliestFrame() const {
  int64_t frame = std::max(frontier_, options_.first_frame);
  while (const Key* key = Neighbour(frame, "")) frame = key->frame + kMinKeyDistance;
  const int64_t end = options_.end_frame.value_or(kMaxDanceFrames + 1);
  return complete_ || frame >= end ? kNoFrame : frame;
}

KeyRejected Timeline::Reject(const std::string& id, int64_t frame, KeyRejected::Code code,
                             std::string reason) {
  if (!frame_of_.contains(id) && rejected_.size() < kMaxKeys) rejected_[id] = frame;
  return {id, frame, EarliestFrame(), std::move(reason), code};
}

KeyRejected Timeline::RejectFrozen(const std::string& id, int64_t frame, KeyRejected::Code code,
                                   const std::string& reason) {
  if (explicit_grants_) return Reject(id, frame, code, reason);
  // Surprises those who edit keys without GenerateUntil.
  KeyRejected rejection =
      Reject(id, frame, code,
             reason + ": as long as no frames are granted, each key freezes what lies before it");
  rejection.remedy = Remedy::kGrantFrames;
  return rejection;
}

std::optional<KeyRejected> Timeline::BeforeTheDance(const std::string& id, int64_t frame) const {
  if (frame >= options_.first_frame) return std::nullopt;
  return KeyRejected{id, frame, EarliestFrame(),
                     "the dance continues from frame " + Frames(options_.first_frame),
                     KeyRejected::Code::kAlreadyDanced};
}

std::optional<KeyRejected> Timeline::Set(Key key, const KeyMoment& when, const std::string& field) {
  CheckOpen(field);
  const std::string id = key.id;
  CheckKeyId(id, field + ".id");
  const int64_t frame = Resolve(when, field);
  key.frame = frame;
  if (options_.end_frame && frame >= *options_.end_frame) {
    const auto* at = std::get_if<AtTime>(&when);
    const double end = static_cast<double>(*options_.end_frame) / options_.fps;
    throw InvalidArgument(
        PathOf(when, field),
        at ? Show(at->seconds) + " s is not before the end of the dance, " + Show(end) + " s"
           : "frame " + Frames(frame) + " is not before the end of the dance, " +
                 Frames(*options_.end_frame));
  }
  const auto same = keys_.find(frame);
  if (same != keys_.end() && same->second.id != id) {
    throw InvalidArgument(
        PathOf(when, field),
        "frame " + Frames(frame) + " is already that of key \"" + same->second.id + '"');
  }
  const auto known = frame_of_.find(id);
  if (known != frame_of_.end() && known->second < frontier_) {
    previous_frame_ = frame;
    return RejectFrozen(id, frame, KeyRejected::Code::kFrozen,
                        "key \"" + id + "\" stands in frozen frames, at " + Frames(known->second));
  }
  if (frame < frontier_) {
    previous_frame_ = frame;
    return RejectFrozen(id, frame, KeyRejected::Code::kTooLate,
                        "frames before " + Frames(frontier_) + " are frozen");
  }
  if (const Key* neighbour = Neighbour(frame, id)) {
    throw InvalidArgument(PathOf(when, field), "frame " + Frames(frame) + " is closer than " +
                                                   std::to_string(kMinKeyDistance) +
                                                   " frames to key \"" + neighbour->id + "\" at " +
                                                   Frames(neighbour->frame));
  }
  if (known == frame_of_.end() && keys_.size() >= kMaxKeys) {
    throw InvalidArgument(
        field, "is one more than the limit of " + std::to_string(kMaxKeys) + " keyframes");
  }
  if (known != frame_of_.end()) keys_.erase(known->second);
  keys_[frame] = std::move(key);
  frame_of_[id] = frame;
  rejected_.erase(id);
  previous_frame_ = frame;
  if (!explicit_grants_) Grant(frame + 1);
  return BeforeTheDance(id, frame);
}

KeyRejected Timeline::RejectInvalid(const std::string& id, const std::optional<KeyMoment>& when,
                                    std::string reason) {
  int64_t frame = kNoFrame;
  try {
    if (when) previous_frame_ = frame = Resolve(*when, "");
  } catch (const Error&) {  // the moment itself is invalid
  }
  size_t length = std::min(id.size(), kMaxIdLength);
  while (length < id.size() && (static_cast<unsigned char>(id[length]) & 0xc0) == 0x80) --length;
  return Reject(id.substr(0, length), frame, KeyRejected::Code::kInvalid, std::move(reason));
}

std::optional<KeyRejected> Timeline::Remove(const std::string& id, const std::string& field) {
  CheckOpen(field);
  const auto known = frame_of_.find(id);
  if (known == frame_of_.end()) {
    const auto rejected = rejected_.find(id);
    if (rejected == rejected_.end()) {
      throw Error(ErrorCode::kNotFound, field + ".id", "there is no key \"" + id + '"');
    }
    return Reject(id, rejected->second, KeyRejected::Code::kRejectedBefore,
                  "key \"" + id + "\" was rejected before");
  }
  if (known->second < frontier_) {
    return RejectFrozen(id, known->second, KeyRejected::Code::kFrozen,
                        "frames before " + Frames(frontier_) + " are frozen");
  }
  const int64_t frame = known->second;
  keys_.erase(frame);
  frame_of_.erase(known);
  return BeforeTheDance(id, frame);
}

int64_t Timeline::Frontier(const std::string& field) const {
  CheckOpen(field);
  return frontier_;
}

void Timeline::NoteChange(int64_t first, int64_t last) {
  if (last >= frontier_) changed_from_ = std::min(changed_from_, first);
}

void Timeline::GenerateUntil(int64_t frame) {
  if (frame < granted_ || frame > kMaxDanceFrames) {
    throw InvalidArgument("until", Frames(frame) + " is not in [" + Frames(granted_) + ", " +
                                       Frames(kMaxDanceFrames) + "]: it may only grow");
  }
  granted_ = frame;
  // Everything is granted. While the music's end is unknown, the last transition cannot be planned.
  if (complete_) return;
  explicit_grants_ = true;
  Grant(frame);
}

void Timeline::Complete() {
  CheckOpen("keys_complete");
  const bool has_end = options_.end_frame || options_.has_music;
  if (!has_end && keys_.empty() && rejected_.empty() && frontier_ <= options_.first_frame) {
    throw Error(ErrorCode::kInvalidArgument, "keys_complete",
                "the dance has no end: no key, no music and no end frame", Remedy::kSetEnd);
  }
  complete_ = true;
  Record(kNever);
}

void Timeline::SetCuts(std::vector<int64_t> frames) {
  cuts_ = std::move(frames);
  planned_.clear();
}

void Timeline::SetCutRule(CutRule rule) {
  cut_rule_ = std::move(rule);
  planned_.clear();
}

void Timeline::SetAudioEnd(int64_t frame) { audio_end_ = frame; }

std::vector<const Key*> Timeline::KeysBehindMusic() const {
  std::vector<const Key*> keys;
  if (options_.end_frame || !audio_end_) return keys;
  for (auto at = keys_.lower_bound(*audio_end_); at != keys_.end(); ++at)
    keys.push_back(&at->second);
  return keys;
}

void Timeline::Grant(int64_t frame) {
  if (frame <= frontier_) return;
  Record(frame);
  frontier_ = frame;
}

void Timeline::Record(int64_t granted) {
  Granted now{granted, KeyFrom(granted), std::exchange(changed_from_, kNever)};
  if (!grants_.empty()) {
    // Clients often grant without a change. Such a grant only extends the previous one.
    Granted& last = grants_.back();
    const bool is_quiet = last.changed_from == kNever && now.changed_from == kNever;
    if (is_quiet && AreEqual(last.next, now.next) && AreEqual(last.next, KeyFrom(last.to))) {
      last.to = granted;
      return;
    }
  }
  grants_.push_back(std::move(now));
}

std::optional<Key> Timeline::KeyFrom(int64_t frame) const {
  const auto key = keys_.lower_bound(frame);
  return key == keys_.end() ? std::nullopt : std::optional(key->second);
}

std::optional<int64_t> Timeline::CutAfter(int64_t frame, bool has_key) const {
  if (cut_rule_ && !has_key) return cut_rule_(frame);
  const auto cut = std::ranges::lower_bound(cuts_, frame + std::lround(kMinCut_s * options_.fps));
  return cut == cuts_.end() ? std::nullopt : std::optional(*cut);
}

// Plans with the keys known when `known` was granted. Earlier keys have been frozen since then;
// later ones have not.
Segment Timeline::SegmentFrom(int64_t frame, const Granted& known) const {
  const auto frozen = keys_.lower_bound(frame);
  const bool is_frozen = frozen != keys_.end() && frozen->first < known.to;
  const std::optional<Key> key = is_frozen ? std::optional(frozen->second) : known.next;
  const auto next = key ? std::optional(key->frame) : std::nullopt;
  int64_t to = TransitionEnd(frame, next,
                             LongestToKey(options_.max_transition_frames, options_.sight_frames));
  const bool is_reached = next && *next + 1 == to;
  if (!is_reached) {
    // The remaining transition before the key is then at least half the typical length.
    const std::optional<int64_t> cut = CutAfter(frame, next.has_value());
    if (cut && *cut <= to + (to - frame) / 2 && *cut - frame <= options_.max_transition_frames)
      to = *cut;
  }
  const bool is_seen = next && !is_reached && IsInSight(frame, *next, options_.sight_frames);
  return {frame, to, is_reached ? key : std::nullopt, to, is_seen ? key : std::nullopt};
}

std::deque<Timeline::Granted>::const_iterator Timeline::GrantBeyond(int64_t frame) const {
  return std::ranges::upper_bound(grants_, frame, {}, &Granted::to);
}

// A later grant stops the transition at the frontier of its time if it found a change.
void Timeline::Settle(PlannedSegment* planned) const {
  Segment& segment = planned->segment;
  for (auto grant = GrantBeyond(planned->settled);
       grant != grants_.end() && planned->settled < segment.stop; ++grant) {
    Segment again = SegmentFrom(segment.from, *grant);
    const bool is_same =
        AreDancedAlike(segment.key, again.key) && AreDancedAlike(segment.later, again.later);
    if (is_same) segment.key = std::move(again.key);  // its hands may have changed
    if (!is_same || grant->changed_from < segment.to) segment.stop = planned->settled;
    planned->settled = grant->to;
  }
}

bool Timeline::PlanNext() {
  const int64_t from = planned_.empty() ? danced_to_ : planned_.back().segment.stop;
  const std::optional<int64_t> end = End();
  const auto grant = GrantBeyond(from);
  if (grant == grants_.end() || (end && from >= *end)) return false;
  planned_.push_back({SegmentFrom(from, *grant), grant->to});
  Settle(&planned_.back());
  return true;
}

const Segment* Timeline::Planned(size_t ahead) {
  if (!planned_.empty()) Settle(&planned_.back());
  while (planned_.size() <= ahead && PlanNext()) {
  }
  return planned_.size() <= ahead ? nullptr : &planned_[ahead].segment;
}

void Timeline::StopAt(int64_t frame) {
  Segment& last = planned_.back().segment;
  last.stop = std::min(last.stop, frame);
}

void Timeline::Finish() {
  danced_to_ = planned_.front().segment.stop;
  planned_.pop_front();
  grants_.erase(grants_.begin(), GrantBeyond(danced_to_));
}

std::optional<int64_t> Timeline::End() const {
  if (options_.end_frame) return options_.end_frame;
  if (!complete_ || (options_.has_music && !audio_end_)) return std::nullopt;
  int64_t end = options_.has_music ? *audio_end_ : frontier_;
  if (!keys_.empty()) end = std::max(end, keys_.rbegin()->first + 1);
  return std::max(end, options_.first_frame);
}

bool Timeline::IsCertain(int64_t frame) const {
  if (!complete_ && frame >= frontier_) return false;
  if (const std::optional<int64_t> end = End()) return frame < *end;
  if (!options_.has_music || !audio_end_ || frame < *audio_end_) return true;
  const auto key = keys_.lower_bound(frame);
  return key != keys_.end() && key->first < frontier_;
}

}  // namespace choreo
