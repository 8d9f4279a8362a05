#include "model/flow/window/time_embedding.h"

#include <cmath>

namespace choreo {
namespace {

double Rate(size_t place, size_t width) {
  return std::pow(10000.0, -2.0 * static_cast<double>(place / 2) / static_cast<double>(width));
}

}  // namespace

double EmbedCountAt(double count, size_t place, size_t width) {
  const double phase = count * Rate(place, width);
  return place % 2 == 0 ? std::sin(phase) : std::cos(phase);
}

CountEmbedding::CountEmbedding(size_t width) {
  for (size_t place = 0; place < width; place += 2) rates_.push_back(Rate(place, width));
}

void CountEmbedding::Fill(double count, std::span<float> embedding) const {
  for (size_t pair = 0; pair < rates_.size(); ++pair) {
    const double phase = count * rates_[pair];
    embedding[2 * pair] = static_cast<float>(std::sin(phase));
    // An odd width has no place for its last cosine.
    if (2 * pair + 1 < embedding.size())
      embedding[2 * pair + 1] = static_cast<float>(std::cos(phase));
  }
}

}  // namespace choreo
