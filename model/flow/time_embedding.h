#pragma once

#include <cstddef>
#include <span>

namespace choreo {

/// Paper F's Eq. 9 for one frame count, at one of `width` places: even ones sine, odd ones cosine,
/// base 10 000.
double EmbedCountAt(double count, size_t place, size_t width);

/// All places of the embedding.
void EmbedCount(double count, std::span<float> embedding);

}  // namespace choreo
