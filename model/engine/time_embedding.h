#pragma once

#include "model/engine/packed_matrix.h"

namespace choreo {

/// EmbedCount of `rows` successive frame counts from `first` on, [rows, width].
RowMajorMatrix TimeEmbeddings(int first, int rows, int width);

}  // namespace choreo
