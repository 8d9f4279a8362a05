#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/core/passage.h"

namespace choreo {

/// The least time between a passage and its original. A shorter repetition would look like
/// trembling.
inline constexpr double kMinReturn_s = 2;

/// Throws Error(kInvalidArgument, "FIELD[3].to") unless passages ascend without overlap, each
/// repeats music that begins at least kMinReturn_s earlier, and all are within the longest music.
void CheckPassages(std::span<const Passage> passages, const std::string& field);

/// Finds the frames of a dance whose music repeats. They share the noise of the frames that they
/// repeat. Frame numbers are absolute, at the model's rate. Not thread-safe.
class Recurrence {
 public:
  Recurrence(double fps, std::span<const Passage> passages);

  bool empty() const { return stretches_.empty() && given_.empty(); }

  /// Replaces known passages from the first given one on, for transitions that begin at `from` or
  /// later. `from` must not decrease between calls. The passages must have passed CheckPassages.
  /// Throws Error(kInvalidArgument, field) beyond kMaxPassages in total.
  void Give(std::span<const Passage> passages, int64_t from, const std::string& field);

  /// Starts the transition from `frame`, which must not decrease between calls.
  void StartTransition(int64_t frame);
  /// The earliest frame that `frame`, in the current transition, repeats; `frame` itself if none.
  int64_t Origin(int64_t frame) const;
  /// The first frame from `least` on, in the current transition, at which a transition should end:
  /// its origin is a multiple of kTypicalFrames, so repeated music is divided alike each time. None
  /// if there is no such frame within kTypicalFrames, as where short repeats follow each other.
  std::optional<int64_t> NextCut(int64_t least) const;
  /// The origins of the frames [from, to); empty if none repeats another.
  std::vector<int64_t> Origins(int64_t from, int64_t to) const;

 private:
  struct Stretch {
    int64_t from, to;  // frames
    int64_t lag;       // distance to the repeated stretch, in frames
  };
  struct Given {
    int64_t from;
    std::vector<Passage> passages;
  };
  void Apply(std::span<const Passage> passages, int64_t from);

  double fps_;
  size_t count_ = 0;                // passages given in total
  std::vector<Stretch> stretches_;  // ascending
  std::deque<Given> given_;         // passages not yet in stretches_
};

/// The frames, ascending, at which transitions without a key should end so that repeated passages
/// are danced alike: where passages and their originals begin and end, and about every
/// kTypicalFrames between. Passages and originals are divided alike. So after a key or a turn of
/// the music shifts transitions, they soon match the original's again.
std::vector<int64_t> CutsOf(std::span<const Passage> passages, double fps);

}  // namespace choreo
