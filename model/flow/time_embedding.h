#pragma once

#include <cstddef>
#include <span>

namespace choreo {

/// Paper F's Eq. 9 of one frame count, at one of `width` places: even ones sine, odd ones cosine,
/// basis 10 000.
double EmbedCountAt(double count, size_t place, size_t width);

/// All places of it.
void EmbedCount(double count, std::span<float> embedding);

}  // namespace choreo
