#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace choreo {

/// Paper F's Eq. 9 for one frame count at one of `width` places: sine at even places, cosine at odd
/// ones, base 10 000.
double EmbedCountAt(double count, size_t place, size_t width);

/// All places of an embedding, for many counts.
class CountEmbedding {
 public:
  explicit CountEmbedding(size_t width);
  /// `embedding` [width]
  void Fill(double count, std::span<float> embedding) const;

 private:
  std::vector<double> rates_;  // of each pair of places
};

}  // namespace choreo
