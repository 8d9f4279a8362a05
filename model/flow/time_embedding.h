#pragma once

#include <span>

namespace choreo {

/// Paper F's Eq. 9 of one frame count: even places sine, odd ones cosine, basis 10 000.
void EmbedCount(double count, std::span<float> embedding);

}  // namespace choreo
