#include "model/flow/time_embedding.h"

#include <cmath>

namespace choreo {

void EmbedCount(double count, std::span<float> embedding) {
  for (size_t i = 0; i < embedding.size(); ++i) {
    const double rate = std::pow(
        10000.0, -2.0 * static_cast<double>(i / 2) / static_cast<double>(embedding.size()));
    const double phase = count * rate;
    embedding[i] = static_cast<float>(i % 2 == 0 ? std::sin(phase) : std::cos(phase));
  }
}

}  // namespace choreo
