#pragma once

#include <cstdint>
#include <vector>

#include "model/draw/picture.h"

namespace choreo {

/// Converts a picture to planar YUV 4:2:0 for video encoders: BT.709, limited range, 8 bits. Luma
/// [height, width] precedes Cb and Cr [height / 2, width / 2]. A chroma sample averages two rows
/// and lies at the left of its two columns (weights 1:2:1 with its neighbours), where H.264 players
/// expect it. Width and height are even. Thread-safe.
std::vector<uint8_t> Yuv420(const Picture& picture);

}  // namespace choreo
