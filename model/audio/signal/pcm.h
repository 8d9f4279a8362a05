#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace choreo {

/// Little-endian PCM bytes → samples, interleaved as they are, full scale [-1, 1]. `floats`: 32-bit
/// floats, else 16-bit integers. Throws Error(kInvalidArgument, `field`) unless they are whole
/// samples of all channels.
std::vector<float> ReadPcm(std::string_view bytes, bool floats, int channels,
                           const std::string& field);

}  // namespace choreo
