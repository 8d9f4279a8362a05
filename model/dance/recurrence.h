#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "model/core/passage.h"

namespace choreo {

/// Repeating sooner would be trembling, not dancing.
inline constexpr double kLeastReturn_s = 2;

/// Throws Error(kInvalidArgument, "FIELD[3].to") unless passages ascend, none begins before the one
/// in front of it ends, each is like one that begins kLeastReturn_s before it or earlier, all
/// within the longest music.
void CheckPassages(std::span<const Passage> passages, const std::string& field);

/// Which frames of a dance repeat, as the music does: they share the noise of the earlier ones.
/// Frames are the model's, absolute. Not thread-safe.
class Recurrence {
 public:
  Recurrence(double fps, std::span<const Passage> passages);

  bool empty() const { return stretches_.empty() && given_.empty(); }

  /// From the first of these on they replace known ones, for transitions that begin at `from` or
  /// later; `from` never decreases between calls. The passages must be checked. Throws
  /// Error(kInvalidArgument, field) beyond kMostPassages in all.
  void Give(std::span<const Passage> passages, int64_t from, const std::string& field);

  /// The next transition starts at this frame; frames never decrease.
  void Begin(int64_t frame);
  /// The first frame that this one repeats, for that transition; itself if none.
  int64_t Origin(int64_t frame) const;
  /// The same for each of these frames; empty if none repeats.
  std::vector<int64_t> Origins(int64_t from, int64_t to) const;

 private:
  struct Stretch {
    int64_t from, to;  // frames
    int64_t lag;       // frames after the one that it repeats
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

/// Frames where passages and their originals begin and end, ascending: a repeated dance becomes
/// similar sooner if its transitions begin there, too.
std::vector<int64_t> CutsOf(std::span<const Passage> passages, double fps);

}  // namespace choreo
