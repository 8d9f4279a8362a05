#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "model/core/error.h"

namespace choreo {

/// Applies `of` to each frame f of mono audio: `size` samples centred at sample f * `hop`, padded
/// with `before` and `after` outside the audio. There are 1 + samples / `hop` frames. Throws
/// Error(kInvalidArgument) for no samples.
template <typename Of>
auto OfCentredFrames(std::span<const float> mono, int size, int hop, Of&& of, float before = 0,
                     float after = 0) {
  if (mono.empty()) throw InvalidArgument("audio", "no samples");
  std::vector<float> window(static_cast<size_t>(size));
  std::vector<decltype(of(std::span<const float>(window)))> made(
      static_cast<size_t>(1 + std::ssize(mono) / hop));
  int64_t start = -size / 2;
  for (auto& one : made) {
    const int64_t from = std::max<int64_t>(start, 0), to = std::min(start + size, std::ssize(mono));
    std::fill(window.begin(), window.end(), start < 0 ? before : after);
    if (from < to)
      std::copy(mono.begin() + from, mono.begin() + to, window.begin() + (from - start));
    one = of(std::span<const float>(window));
    start += hop;
  }
  return made;
}

}  // namespace choreo
