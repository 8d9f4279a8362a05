#pragma once

#include <cstdint>
#include <vector>

#include "model/draw/picture.h"

namespace choreo {

/// A picture as video encoders take it: BT.709, limited range, 8 bits. [height, width] of luma,
/// then [height / 2, width / 2] of Cb and of Cr, each of two rows and at the left one of its two
/// columns (1:2:1 with those beside it), where players of H.264 put it. Width and height are even.
/// Thread-safe.
std::vector<uint8_t> Yuv420(const Picture& picture);

}  // namespace choreo
