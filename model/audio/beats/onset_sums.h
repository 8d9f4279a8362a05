#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/beats/onset.h"

namespace choreo {

/// The share of `on`, the onsets on beats, in excess of `even`, the value for evenly spread onsets:
/// 0 to 1.
inline double Excess(double on, double even) { return on > even ? 1 - even / on : 0; }

/// Sums the strengths of onsets (OnsetStrength) over frames and around beats. Outside the music
/// they are 0. Immutable.
class OnsetSums {
 public:
  static constexpr int64_t kBeatFrames = 4;  // of a beat: from one before it to two after it

  explicit OnsetSums(std::span<const Onset> onsets) {
    for (const float strength : OnsetStrength(onsets)) sums_.push_back(sums_.back() + strength);
  }
  /// The sum over the frames [from, to).
  double Between(int64_t from, int64_t to) const { return Before(to) - Before(from); }
  /// The sum around a beat at `frame`.
  double OnBeat(int64_t frame) const { return Between(frame - 1, frame - 1 + kBeatFrames); }
  int64_t frames() const { return std::ssize(sums_) - 1; }

 private:
  double Before(int64_t frame) const {
    return sums_[static_cast<size_t>(std::clamp<int64_t>(frame, 0, frames()))];
  }

  std::vector<double> sums_{0};
};

}  // namespace choreo
