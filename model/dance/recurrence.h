#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/core/passage.h"

namespace choreo {

/// Throws Error(kInvalidArgument, "FIELD[3].to") unless passages ascend, none begins before the one
/// in front of it ends, each is like one that begins before it, all within the longest music, and
/// they are at most kMostPassages.
void CheckPassages(std::span<const Passage> passages, const std::string& field);

/// Which frames of a dance come back, as the music does: they have the noise of those that they are
/// like, and transitions begin where those began. Frames are the model's, absolute. Not
/// thread-safe.
class Recurrence {
 public:
  /// The passages are checked.
  Recurrence(double fps, std::span<const Passage> passages);

  /// From the first of these on they hold in place of those that were known, for frames from `from`
  /// on.
  void Give(std::span<const Passage> passages, int64_t from);

  /// The first frame that this one is like; itself where nothing comes back.
  int64_t Origin(int64_t frame) const;
  /// Of each of these frames; empty where none of them comes back.
  std::vector<int64_t> Origins(int64_t from, int64_t to) const;

  /// Frames where passages, and what they are like, begin and end: ascending, at least half a
  /// second apart.
  const std::vector<int64_t>& cuts() const { return cuts_; }

 private:
  struct Stretch {
    int64_t from, to;  // frames
    int64_t lag;       // behind the one that it is like
  };
  void Cut();

  double fps_;
  std::vector<Stretch> stretches_;  // ascending
  std::vector<int64_t> cuts_;
};

}  // namespace choreo
