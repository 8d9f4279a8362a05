#include "model/engine/time_embedding.h"

#include "model/flow/time_embedding.h"

namespace choreo {

RowMajorMatrix TimeEmbeddings(int first, int rows, int width) {
  RowMajorMatrix embeddings(rows, width);
  for (int row = 0; row < rows; ++row)
    EmbedCount(first + row, {embeddings.row(row).data(), static_cast<size_t>(width)});
  return embeddings;
}

}  // namespace choreo
