#include "model/engine/time_embedding.h"

#include <cmath>

namespace choreo {

RowMajorMatrix TimeEmbeddings(int first, int rows, int width) {
  RowMajorMatrix embeddings(rows, width);
  for (int i = 0; i < width; ++i) {
    const double rate = std::pow(10000.0, -2.0 * (i / 2) / width);
    for (int row = 0; row < rows; ++row) {
      const double phase = (first + row) * rate;
      embeddings(row, i) = static_cast<float>(i % 2 == 0 ? std::sin(phase) : std::cos(phase));
    }
  }
  return embeddings;
}

}  // namespace choreo
