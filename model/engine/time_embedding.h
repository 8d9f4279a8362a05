#pragma once

#include "model/engine/packed_matrix.h"

namespace choreo {

/// Paper F's Eq. 9 for `rows` successive frame counts from `first` on, [rows, width]: even places
/// sine, odd ones cosine, basis 10 000 (TimeEmbedding of model/flow/planner.h without LibTorch).
RowMajorMatrix TimeEmbeddings(int first, int rows, int width);

}  // namespace choreo
