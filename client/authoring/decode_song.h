#pragma once

#include <filesystem>

#include "model/audio/decode.h"

namespace choreo::authoring {

/// Decodes any song: by DecodeAudioFile or, if that does not know the format and ffmpeg is
/// installed, by ffmpeg. Fails like DecodeAudioFile. Writes notes to standard error.
DecodedAudio DecodeSong(const std::filesystem::path& path, double seconds, double start,
                        double more = 0);

}  // namespace choreo::authoring
