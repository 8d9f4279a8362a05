#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "model/core/limits.h"
#include "model/messages/dance_event.h"
#include "model/motion/motion.h"

/// Keys on the grid of the model's frames, and how they cut a dance into transitions.
namespace choreo {

/// When a key is due. Times round to the nearest frame; the frame and its time are reported with
/// the key.
struct AtFrame {
  int64_t frame = 0;  ///< absolute, frame 0 at time 0
};
struct AtTime {
  double seconds = 0;  ///< absolute
};
/// After the key of the keyframe message before this one (after frame 0 for the first).
struct AfterPrevious {
  int64_t frames = 0;
};
using KeyMoment = std::variant<AtFrame, AtTime, AfterPrevious>;

/// A key pose at a frame. World frame.
struct Key {
  std::string id;
  int64_t frame = 0;
  Pose pose;
  PoseMask mask;
  bool operator==(const Key& other) const;
};

/// One transition to dance: frames [from, to). With a key, its frame is to - 1. Of these, the
/// frames before `stop` are danced: `to`, or where a change cut it off.
struct Segment {
  int64_t from = 0;
  int64_t to = 0;
  std::optional<Key> key;
  int64_t stop = to;
};

/// Where the transition that begins at `from` ends: just after the next key or, without one within
/// `longest` frames, after about kUsualFrames, at most half the longest. So the rest before a key
/// is never shorter than that.
int64_t TransitionEnd(int64_t from, std::optional<int64_t> next_key, int longest);

/// The keys of one dance, the frozen frontier, and the plan that follows from them. Each call
/// plans, before it returns, every transition (TransitionEnd) of which a frame is granted by then,
/// so the plan depends on the order of the calls alone. GenerateUntil and Complete grant; where
/// nobody grants, each accepted key does, up to and with itself. A transition that reaches over the
/// frontier goes on as long as it is the one that would be planned from its first frame now, and
/// nobody said Disturb; else it stops at the frontier. A dance that goes on is told the same again:
/// keys before its first frame stand where they stood, and are answered by a rejection. Not
/// thread-safe.
class Timeline {
 public:
  struct Options {
    double fps = kModelFps;
    int64_t first_frame = 0;  ///< where the dance starts (a continuation's frame)
    /// The dance is frames [first_frame, end_frame); no key at or after it.
    std::optional<int64_t> end_frame = {};
    bool has_music = false;
    /// As by GenerateUntil, before all messages; none: keys grant.
    std::optional<int64_t> granted = {};
    int max_transition_frames = kMaxTransitionFrames;  ///< of the model
  };
  explicit Timeline(Options options);

  /// Adds a key, or moves (replaces) the one with this id. `field` is the sender's path for errors,
  /// as in "keyframes[3]". Returns a rejection if the key, or the one it replaces, stands in frozen
  /// frames. Throws Error(kInvalidArgument) for an empty id, a moment out of range, a frame that
  /// another id has, one closer than kMinKeyDistance to another key, for more than kMaxKeys, and
  /// after Complete. The pose is taken as it is: see validation.h.
  std::optional<KeyRejected> Set(const std::string& id, const KeyMoment& when, const Pose& pose,
                                 const PoseMask& mask, const std::string& field);

  /// Throws Error(kNotFound) for an id that is not on the timeline, Error(kInvalidArgument) after
  /// Complete.
  std::optional<KeyRejected> Remove(const std::string& id, const std::string& field);

  /// Where what is said now holds from: the frontier. Throws Error(kInvalidArgument) after
  /// Complete, when all is frozen.
  int64_t Frontier(const std::string& field) const;

  /// Something else than keys changes for frames of [first, last].
  void Disturb(int64_t first = 0, int64_t last = std::numeric_limits<int64_t>::max());

  /// Grants, and freezes, the frames before this one: keys there are late from now on. Changes
  /// nothing after Complete. Throws Error(kInvalidArgument) if it shrinks or is out of range.
  void GenerateUntil(int64_t frame);

  /// No more keys; all is granted. Throws Error(kInvalidArgument) the second time, and where the
  /// dance would have no end: no end_frame, no music, no key, not even a late one, no grant.
  void Complete();

  /// Where transitions without a key should end, ascending: one whose usual end is near the next of
  /// these ends there, if that is half a second away at least. Before anything is danced.
  void SetCuts(std::vector<int64_t> frames);

  /// The music ends before `frame`.
  void SetAudioEnd(int64_t frame);

  /// The transition to be danced now (0), and those behind it; null while none may start. The
  /// `stop` of the last one may change until it is done; others are frozen. After Complete with
  /// music that has not ended they never run dry.
  const Segment* Planned(size_t ahead = 0);
  /// The current transition is danced up to its stop.
  void Finish();

  /// Where the dance ends (exclusive), once known: given end_frame, there. Else after Complete (and
  /// with music after SetAudioEnd) at the end of the music or the last key, whichever is later;
  /// without music at the last key, or where frames were granted to by then if that is further.
  std::optional<int64_t> End() const;

  /// True if this frame is granted and the dance has it for certain. Past the end of the music it
  /// is open whether the dance goes on as long as a key may still come or not.
  bool Certain(int64_t frame) const;

  bool complete() const { return complete_; }

 private:
  int64_t Resolve(const KeyMoment& when, const std::string& field) const;
  void CheckOpen(const std::string& field) const;
  const Key* Neighbour(int64_t frame, const std::string& except_id) const;
  // First frame that a new key could have now.
  int64_t EarliestFrame() const;
  KeyRejected Reject(const std::string& id, int64_t frame, KeyRejected::Code why,
                     std::string reason);
  std::string WhyFrozen() const;
  std::optional<KeyRejected> BeforeTheDance(const std::string& id, int64_t frame) const;
  void Grant(int64_t frame);
  void CutIfChanged();
  Segment From(int64_t frame) const;
  void PlanTo(int64_t frame);

  Options options_;
  std::map<int64_t, Key> keys_;  // by frame; danced ones included
  std::unordered_map<std::string, int64_t> frame_of_;
  std::unordered_map<std::string, int64_t> rejected_;  // ids that only ever came late, and where
  int64_t previous_frame_ = 0;  // of the last keyframe message, for AfterPrevious
  int64_t granted_ = 0;         // by GenerateUntil
  int64_t frontier_ = 0;        // frames before it are frozen
  bool explicit_grants_ = false;
  bool disturbed_ = false;  // the transition that reaches over the frontier
  bool complete_ = false;
  std::optional<int64_t> audio_end_;
  std::vector<int64_t> cuts_;
  int64_t planned_to_;
  std::deque<Segment> planned_;  // the first one is the current
};

}  // namespace choreo
