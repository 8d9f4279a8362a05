#include "model/flow/time_embedding.h"

#include <cmath>

namespace choreo {

double EmbedCountAt(double count, size_t place, size_t width) {
  const double rate =
      std::pow(10000.0, -2.0 * static_cast<double>(place / 2) / static_cast<double>(width));
  const double phase = count * rate;
  return place % 2 == 0 ? std::sin(phase) : std::cos(phase);
}

void EmbedCount(double count, std::span<float> embedding) {
  for (size_t i = 0; i < embedding.size(); ++i)
    embedding[i] = static_cast<float>(EmbedCountAt(count, i, embedding.size()));
}

}  // namespace choreo
