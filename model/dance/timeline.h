#pragma once

#include <cstdint>
#include <deque>
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

/// Keys on the model's frame grid, and how they divide a dance into transitions.
namespace choreo {

/// One transition to dance: frames [from, to). A key is at frame to - 1. Only frames before `stop`
/// are danced; `stop` is `to` unless a change cut the transition short.
struct Segment {
  int64_t from = 0;
  int64_t to = 0;
  std::optional<Key> key = {};
  int64_t stop = to;
  std::optional<Key> later = {};  ///< the next key in sight, if it is not reached
};

/// The end of the transition that begins at `from`: just after the next key or, without one within
/// `longest` frames, after about kTypicalFrames, at most half the longest. So the rest before a key
/// is never shorter.
int64_t TransitionEnd(int64_t from, std::optional<int64_t> next_key, int longest);
/// TransitionEnd's `longest` for a model. A model that sees later keys needs no long transitions,
/// so its dances follow the music every two seconds.
int LongestToKey(int max_transition_frames, int sight_frames);
/// Whether a transition that begins at `from` and does not reach this key sees it.
inline bool IsInSight(int64_t from, int64_t key, int sight_frames) {
  return key + 1 - from <= sight_frames;
}

/// The keys of one dance, the frozen frontier, and the plan that follows from them. A transition
/// (TransitionEnd) is planned with the keys that were known when its first frame was granted, so
/// the plan depends only on the order of calls, never on when it is asked for. GenerateUntil and
/// Complete grant frames; without them each accepted key grants the frames up to and including its
/// own. A transition across the frontier continues as long as planning from its first frame would
/// give it again and NoteChange has not been called; otherwise it stops at the frontier. Music that
/// changes ends a transition, too (StopAt). A resumed dance receives the same messages again: keys
/// before its first frame keep their places and are answered with a rejection. Not thread-safe.
class Timeline {
 public:
  struct Options {
    double fps = kModelFps;
    int64_t first_frame = 0;  ///< where the dance starts (the continuation's frame)
    /// The dance is frames [first_frame, end_frame), and keys must be in them.
    std::optional<int64_t> end_frame = {};
    bool has_music = false;
    /// Granted as if by GenerateUntil before all messages; none: keys grant.
    std::optional<int64_t> granted = {};
    int max_transition_frames = kMaxTransitionFrames;  ///< the model's
    int sight_frames = 0;                              ///< the model's
  };
  explicit Timeline(Options options);

  /// Adds a key at `when`, or moves (replaces) the one with this id. `field` is the sender's path
  /// for errors, as in "keyframes[3]". Returns a rejection if the key, or the one it replaces, is
  /// in frozen frames. Throws Error(kInvalidArgument) for an empty id, a moment out of range, a
  /// frame that another id has, one closer than kMinKeyDistance to another key, for more than
  /// kMaxKeys, and after Complete. The pose and `hit` must be valid (validation.h).
  std::optional<KeyRejected> Set(Key key, const KeyMoment& when, const std::string& field);

  /// Rejects a key that cannot be used, for this reason; changes nothing. `when`: none if the
  /// message has no moment.
  KeyRejected RejectInvalid(const std::string& id, const std::optional<KeyMoment>& when,
                            std::string reason);

  /// Throws Error(kNotFound) for an id that is not on the timeline, Error(kInvalidArgument) after
  /// Complete.
  std::optional<KeyRejected> Remove(const std::string& id, const std::string& field);

  /// The first frame that a message can still change. Throws Error(kInvalidArgument) after
  /// Complete, when all is frozen.
  int64_t Frontier(const std::string& field) const;

  /// Notes that something other than keys has changed for frames of [first, last].
  void NoteChange(int64_t first = 0, int64_t last = std::numeric_limits<int64_t>::max());

  /// Grants and freezes the frames before this one; keys there are late from now on. Does nothing
  /// after Complete. Throws Error(kInvalidArgument) if the frame decreases or is out of range.
  void GenerateUntil(int64_t frame);

  /// Says that no more keys come, and grants all. Throws Error(kInvalidArgument) if called twice,
  /// and if the dance would have no end: without end_frame, music, grant or any key, even a late
  /// one.
  void Complete();

  /// Sets frames where transitions without a key should end, ascending. A transition that would end
  /// near such a frame ends on it, unless that makes it shorter than half a second. Call before
  /// anything is danced.
  void SetCuts(std::vector<int64_t> frames);

  /// Says that the music ends before `frame`.
  void SetAudioEnd(int64_t frame);
  /// The keys behind the music's end that prolong the dance: none with end_frame, or while the
  /// music goes on.
  std::vector<const Key*> KeysBehindMusic() const;
  /// How far this frame lies behind the music's end, which must be known.
  double SecondsBehindMusic(int64_t frame) const {
    return static_cast<double>(frame - *audio_end_) / options_.fps;
  }

  /// The current transition (0) or a later one; null while none may start. The `stop` of the last
  /// may change until it is done or a later one was asked for. After Complete, while the music has
  /// not ended, there is always another.
  const Segment* Planned(size_t ahead = 0);
  /// Stops at `frame` the last transition asked for, if it lasts until then.
  void StopAt(int64_t frame);
  /// Marks the current transition as danced up to its stop.
  void Finish();

  /// The end of the dance (exclusive), once known: end_frame if given. Else, after Complete (and,
  /// with music, SetAudioEnd): with music its end or the last key, whichever is later; without
  /// music the last key or the end of the granted frames, whichever is later.
  std::optional<int64_t> End() const;

  /// True if this frame is granted and certain to be danced. After the end of the music frames are
  /// uncertain as long as a key may still come.
  bool IsCertain(int64_t frame) const;

  bool complete() const { return complete_; }

 private:
  // A grant, and what was known of the frames after it when it came.
  struct Granted {
    int64_t to;               // it froze the frames before this one
    std::optional<Key> next;  // the first key after them
    int64_t changed_from;     // the first frame that NoteChange named since the grant before
  };
  struct Plan {
    Segment segment;
    int64_t settled;  // grants of frames before this one have been looked at
  };

  int64_t Resolve(const KeyMoment& when, const std::string& field) const;
  void CheckOpen(const std::string& field) const;
  const Key* Neighbour(int64_t frame, const std::string& except_id) const;
  // The first frame that a new key may have now.
  int64_t EarliestFrame() const;
  KeyRejected Reject(const std::string& id, int64_t frame, KeyRejected::Code why,
                     std::string reason);
  std::string WhyFrozen() const;
  std::optional<KeyRejected> BeforeTheDance(const std::string& id, int64_t frame) const;
  void Grant(int64_t frame);
  void Record(int64_t granted);
  std::optional<Key> KeyFrom(int64_t frame) const;
  Segment SegmentFrom(int64_t frame, const Granted& known) const;
  std::deque<Granted>::const_iterator GrantBeyond(int64_t frame) const;
  void Settle(Plan* plan) const;
  bool PlanNext();

  Options options_;
  std::map<int64_t, Key> keys_;  // by frame; danced ones included
  std::unordered_map<std::string, int64_t> frame_of_;
  std::unordered_map<std::string, int64_t> rejected_;  // ids of keys that only came late -> frame
  int64_t previous_frame_ = 0;  // of the last keyframe message, for AfterPrevious
  int64_t granted_ = 0;         // by GenerateUntil
  int64_t frontier_ = 0;        // frames before it are frozen
  bool explicit_grants_ = false;
  int64_t changed_from_;  // Granted::changed_from of the next grant
  bool complete_ = false;
  std::optional<int64_t> audio_end_;
  std::vector<int64_t> cuts_;
  std::deque<Granted> grants_;  // those that the current transition and later ones depend on
  int64_t danced_to_;           // where the current transition begins
  std::deque<Plan> planned_;    // the first is the current one
};

}  // namespace choreo
