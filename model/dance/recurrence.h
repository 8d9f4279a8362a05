#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "model/core/passage.h"

namespace choreo {

/// A shorter repetition would look like trembling.
inline constexpr double kMinReturn_s = 2;

/// Throws Error(kInvalidArgument, "FIELD[3].to") unless passages ascend without overlap, each
/// repeats one that begins at least kMinReturn_s earlier, and all lie within the longest music.
void CheckPassages(std::span<const Passage> passages, const std::string& field);

/// Finds which frames of a dance repeat earlier ones, as the music does. They share the earlier
/// frames' noise. Frames are the model's, absolute. Not thread-safe.
class Recurrence {
 public:
  Recurrence(double fps, std::span<const Passage> passages);

  bool empty() const { return stretches_.empty() && given_.empty(); }

  /// Replaces known passages from the first of these on, for transitions that begin at `from` or
  /// later; `from` never decreases between calls. The passages must be checked. Throws
  /// Error(kInvalidArgument, field) beyond kMaxPassages in total.
  void Give(std::span<const Passage> passages, int64_t from, const std::string& field);

  /// The next transition starts at this frame; frames never decrease.
  void Begin(int64_t frame);
  /// The earliest frame that this one repeats, for the transition of Begin; itself if none.
  int64_t Origin(int64_t frame) const;
  /// The same for each of these frames; empty if none repeats.
  std::vector<int64_t> Origins(int64_t from, int64_t to) const;

 private:
  struct Stretch {
    int64_t from, to;  // frames
    int64_t lag;       // frames since the stretch that it repeats
  };
  struct Given {
    int64_t from;
    std::vector<Passage> passages;
  };
  void Take(std::span<const Passage> passages, int64_t from);

  double fps_;
  size_t count_ = 0;                // given in all
  std::vector<Stretch> stretches_;  // ascending
  std::deque<Given> given_;         // not yet in stretches_
};

/// The frames where transitions without a key should end so that a repeated dance becomes similar,
/// ascending: where passages and their originals begin and end, and about every kTypicalFrames
/// between. Passages and originals are cut alike, so transitions that a key or a turn of the music
/// has shifted are soon those of the original again.
std::vector<int64_t> CutsOf(std::span<const Passage> passages, double fps);

}  // namespace choreo
