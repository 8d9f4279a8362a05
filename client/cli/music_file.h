#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "model/audio/decode.h"

namespace choreo::cli {

/// Decodes any song: by DecodeAudioFile or, if that does not know the format and ffmpeg is
/// installed, by ffmpeg. Errors as DecodeAudioFile. Writes notes to standard error.
DecodedAudio DecodeSong(const std::filesystem::path& path, double seconds, double start);

/// An existing file, a pipe, or `-` for standard input.
CLI::Validator SongFile();

}  // namespace choreo::cli
