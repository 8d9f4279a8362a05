#pragma once

#include <algorithm>

namespace choreo {

/// Tempi that differ by less than this share, a semitone's, are one.
inline constexpr double kSameTempo = 0.06;

inline bool IsSameTempo(double bpm, double other) {
  return std::max(bpm / other, other / bpm) <= 1 + kSameTempo;
}

}  // namespace choreo
