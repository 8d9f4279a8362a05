#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

/// What the tracks of controls share: the frames for which their requests hold.
namespace choreo {

/// A value that applies to transitions that begin at `from` or later. Copies share it.
template <typename What>
struct EffectiveFrom {
  int64_t from;
  std::shared_ptr<const What> what;
};

/// The frames that a control's request may change.
struct ChangedFrames {
  int64_t first = 0;
  int64_t last = std::numeric_limits<int64_t>::max();
};

/// A frame's place among a control's ascending rows: the row at or before it, and the share of the
/// way to the next row, 0 to 1. Outside the rows the nearest one applies. Without frames, one row
/// is for all.
struct RowPlace {
  size_t row = 0;
  float share = 0;
};
inline RowPlace PlaceAmong(const std::vector<int64_t>& frames, int64_t frame) {
  const auto after = static_cast<size_t>(std::ranges::upper_bound(frames, frame) - frames.begin());
  if (after == 0) return {};
  if (after == frames.size()) return {after - 1, 0};
  return {after - 1, static_cast<float>(frame - frames[after - 1]) /
                         static_cast<float>(frames[after] - frames[after - 1])};
}

}  // namespace choreo
