#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/core/limits.h"
#include "model/messages/dance_event.h"
#include "model/messages/key.h"

/// Keys on the model's frame grid, and the transitions into which they divide a dance.
namespace choreo {

/// One transition: frames [from, to), with a key, if any, at frame to - 1. Only frames before
/// `stop` are danced; `stop` is `to` unless a change cuts the transition short.
struct Segment {
  int64_t from = 0;
  int64_t to = 0;
  std::optional<Key> key = {};
  int64_t stop = to;
  std::optional<Key> later = {};  ///< the next key in sight, if this transition does not reach it
};

/// The end of the transition that begins at `from`: just after the next key or, if none is within
/// `longest` frames, after about kTypicalFrames, at most half of `longest`. So the last transition
/// before a key is never shorter than that.
int64_t TransitionEnd(int64_t from, std::optional<int64_t> next_key, int longest);
/// TransitionEnd's `longest` for a model. A model that sees later keys needs no long transitions,
/// so its dances adapt to the music every two seconds.
int LongestToKey(int max_transition_frames, int sight_frames);
/// Whether a transition that begins at `from`, and does not reach the key at frame `key`, sees it.
inline bool IsInSight(int64_t from, int64_t key, int sight_frames) {
  return key + 1 - from <= sight_frames;
}

/// The keys of one dance, the frontier of frozen frames, and the resulting plan of transitions. A
/// transition (TransitionEnd) is planned with the keys known when its first frame was granted, so
/// the plan depends only on the order of calls, never on when it is queried. GenerateUntil and
/// Complete grant frames; without them each accepted key grants the frames up to and including its
/// own. A transition across the frontier continues as long as planning from its first frame would
/// still give it and NoteChange has not been called; otherwise it stops at the frontier. A change
/// in the music ends a transition, too (StopAt). A resumed dance receives all messages again: keys
/// before its first frame keep their places and are answered with a rejection. Not thread-safe.
class Timeline {
 public:
  struct Options {
    double fps = kModelFps;
    int64_t first_frame = 0;  ///< where the dance starts (the continuation's frame)
    /// The end of the dance. Its frames are [first_frame, end_frame), and keys must be in that
    /// range.
    std::optional<int64_t> end_frame = {};
    bool has_music = false;
    /// Frames granted as by GenerateUntil before all messages; none: keys grant frames.
    std::optional<int64_t> granted = {};
    int max_transition_frames = kMaxTransitionFrames;  ///< the model's
    int sight_frames = 0;                              ///< the model's
  };
  explicit Timeline(Options options);

  /// Adds a key at `when`, or replaces the one with its id. `field`: the caller's name for the key,
  /// for errors, as in "keyframes[3]". Returns a rejection without adding the key if its frame is
  /// frozen (kTooLate) or the replaced key's is (kFrozen); AfterPrevious then still counts from the
  /// key. Returns kAlreadyDanced for an added key before Options::first_frame, which grants frames
  /// as any key does. Throws Error(kInvalidArgument) for an empty id, a moment out of range, a
  /// frame taken by another id, a frame closer than kMinKeyDistance to another key, more than
  /// kMaxKeys keys, and after Complete. The pose and `hit` must be valid (validation.h).
  std::optional<KeyRejected> Set(Key key, const KeyMoment& when, const std::string& field);

  /// Rejects an unusable key: keys and frames stay, but Remove and Complete know its id as
  /// rejected, and AfterPrevious counts from its moment. `when`: none if the message has no moment.
  KeyRejected RejectInvalid(const std::string& id, const std::optional<KeyMoment>& when,
                            std::string reason);

  /// Removes a key. Returns a rejection without removing anything if the key's frame is frozen
  /// (kFrozen) or the key was itself rejected (kRejectedBefore). Returns kAlreadyDanced for a
  /// removed key before Options::first_frame. Throws Error(kNotFound) for any other id, and
  /// Error(kInvalidArgument) after Complete.
  std::optional<KeyRejected> Remove(const std::string& id, const std::string& field);

  /// The first frame that a message can still change. Throws Error(kInvalidArgument) after
  /// Complete, when all frames are frozen.
  int64_t Frontier(const std::string& field) const;

  /// Records a change other than of keys for the frames [first, last].
  void NoteChange(int64_t first = 0, int64_t last = std::numeric_limits<int64_t>::max());

  /// Grants and freezes the frames before `frame`; keys there are late from now on. Does nothing
  /// after Complete. Throws Error(kInvalidArgument) if `frame` decreases or is out of range.
  void GenerateUntil(int64_t frame);

  /// Ends the keys, and grants all frames. Throws Error(kInvalidArgument) if called twice, and if
  /// the dance would have no end: without end_frame, music, grants and any key, even a late one.
  void Complete();

  /// Sets the frames, ascending, at which transitions without a key should end. A transition that
  /// would end near such a frame ends on it, unless that makes it shorter than half a second. Call
  /// before any frame is danced.
  void SetCuts(std::vector<int64_t> frames);
  /// Finds the frame at which a transition from `from` should end, if any. `from` ascends from call
  /// to call.
  using CutRule = std::function<std::optional<int64_t>(int64_t from)>;
  /// Sets `rule` instead, for transitions without any key ahead. Call before any frame is danced.
  void SetCutRule(CutRule rule);

  /// Sets the music's end, just before `frame`.
  void SetAudioEnd(int64_t frame);
  /// The keys after the music's end, which prolong the dance. Empty with end_frame, or while the
  /// music's end is unknown.
  std::vector<const Key*> KeysBehindMusic() const;
  /// The time from the music's end, which must be known, to `frame`.
  double SecondsBehindMusic(int64_t frame) const {
    return static_cast<double>(frame - *audio_end_) / options_.fps;
  }

  /// The current transition (0) or a later one; null while none may start. The `stop` of the last
  /// one may change until it is done or a later one is queried. After Complete, there is always
  /// another one until the music's end is set.
  const Segment* Planned(size_t ahead = 0);
  /// Stops the last queried transition at `frame`, if it lasts until then.
  void StopAt(int64_t frame);
  /// Marks the current transition as danced up to its stop.
  void Finish();

  /// The end of the dance (exclusive), once known: end_frame if given. Otherwise it is known after
  /// Complete and, with music, SetAudioEnd. With music it is the music's end or the last key,
  /// whichever is later; without music, the last key or the end of the granted frames, whichever is
  /// later.
  std::optional<int64_t> End() const;

  /// Whether this frame is granted and certain to be danced. Frames after the music's end are
  /// uncertain as long as more keys may come.
  bool IsCertain(int64_t frame) const;

  bool complete() const { return complete_; }

 private:
  // A grant, and what was then known about the frames after it.
  struct Granted {
    int64_t to;               // the first frame that it did not freeze
    std::optional<Key> next;  // the first key after them
    int64_t changed_from;     // the first frame named in NoteChange since the previous grant
  };
  struct PlannedSegment {
    Segment segment;
    int64_t settled;  // grants of frames before this one have been processed
  };

  int64_t Resolve(const KeyMoment& when, const std::string& field) const;
  void CheckOpen(const std::string& field) const;
  const Key* Neighbour(int64_t frame, const std::string& except_id) const;
  // The first frame that a new key may have now; -1 if none is left.
  int64_t EarliestFrame() const;
  KeyRejected Reject(const std::string& id, int64_t frame, KeyRejected::Code why,
                     std::string reason);
  KeyRejected RejectFrozen(const std::string& id, int64_t frame, KeyRejected::Code why,
                           const std::string& reason);
  std::optional<KeyRejected> BeforeTheDance(const std::string& id, int64_t frame) const;
  void Grant(int64_t frame);
  void Record(int64_t granted);
  std::optional<Key> KeyFrom(int64_t frame) const;
  Segment SegmentFrom(int64_t frame, const Granted& known) const;
  std::deque<Granted>::const_iterator GrantBeyond(int64_t frame) const;
  void Settle(PlannedSegment* planned) const;
  std::optional<int64_t> CutAfter(int64_t frame, bool has_key) const;
  bool PlanNext();

  Options options_;
  std::map<int64_t, Key> keys_;  // by frame, including danced keys
  std::unordered_map<std::string, int64_t> frame_of_;
  std::unordered_map<std::string, int64_t> rejected_;  // id -> frame; those not in keys_
  int64_t previous_frame_ = 0;  // frame of the last keyframe message, for AfterPrevious
  int64_t granted_ = 0;         // by GenerateUntil
  int64_t frontier_ = 0;        // the first frame that is not frozen
  bool explicit_grants_ = false;
  int64_t changed_from_;  // Granted::changed_from for the next grant
  bool complete_ = false;
  std::optional<int64_t> audio_end_;
  std::vector<int64_t> cuts_;
  CutRule cut_rule_;
  std::deque<Granted> grants_;          // grants on which current and later transitions depend
  int64_t danced_to_;                   // where the current transition begins
  std::deque<PlannedSegment> planned_;  // the first is the current one
};

}  // namespace choreo
