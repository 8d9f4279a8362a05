#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "model/core/passage.h"

namespace choreo {

/// Whoever did the same less long ago would tremble, not dance.
inline constexpr double kLeastReturn_s = 2;

/// Throws Error(kInvalidArgument, "FIELD[3].to") unless passages ascend, none begins before the one
/// in front of it ends, each is like one that begins kLeastReturn_s before it or earlier, all
/// within the longest music.
void CheckPassages(std::span<const Passage> passages, const std::string& field);

/// Which frames of a dance come back, as the music does: they have the noise of those that they are
/// like. Frames are the model's, absolute. Not thread-safe.
class Recurrence {
 public:
  Recurrence(double fps, std::span<const Passage> passages);

  bool empty() const { return stretches_.empty() && given_.empty(); }

  /// From the first of these on they hold in place of those that were known, for transitions that
  /// begin at `from` or later; `from` never shrinks from call to call. The passages are checked.
  /// Throws Error(kInvalidArgument, field) beyond kMostPassages in all.
  void Give(std::span<const Passage> passages, int64_t from, const std::string& field);

  /// The transition from this frame on is the next; frames never shrink.
  void Begin(int64_t frame);
  /// The first frame that this one is like, for that transition; itself where nothing comes back.
  int64_t Origin(int64_t frame) const;
  /// Of each of these frames; empty where none of them comes back.
  std::vector<int64_t> Origins(int64_t from, int64_t to) const;

 private:
  struct Stretch {
    int64_t from, to;  // frames
    int64_t lag;       // behind the one that it is like
  };
  struct Given {
    int64_t from;
    std::vector<Passage> passages;
  };
  void Take(std::span<const Passage> passages, int64_t from);

  double fps_;
  size_t count_ = 0;                // of all that was given
  std::vector<Stretch> stretches_;  // ascending
  std::deque<Given> given_;         // not yet in stretches_
};

/// Frames where passages, and what they are like, begin and end, ascending: a dance that comes back
/// is alike the sooner where its transitions begin there, too.
std::vector<int64_t> CutsOf(std::span<const Passage> passages, double fps);

}  // namespace choreo
