#pragma once

#include <filesystem>

#include "model/audio/decode/decode.h"

namespace choreo::authoring {

/// Decodes a song of any format: with DecodeAudioFile or, if it does not support the format and
/// ffmpeg is installed, with ffmpeg. Throws as DecodeAudioFile does. Notes go to the sink
/// (notes.h), too.
DecodedAudio DecodeSong(const std::filesystem::path& path, double seconds, double start,
                        double more = 0);

}  // namespace choreo::authoring
