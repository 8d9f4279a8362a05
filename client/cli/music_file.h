#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "model/audio/decode.h"

namespace choreo::cli {

/// A song of any kind: DecodeAudioFile, or, where that does not know the format and the program
/// ffmpeg is installed, what ffmpeg makes of it. Errors as DecodeAudioFile. Writes its notes to
/// standard error.
DecodedAudio DecodeSong(const std::filesystem::path& path, double seconds, double start);

/// An existing file, a pipe, or `-`, which is standard input.
CLI::Validator SongFile();

}  // namespace choreo::cli
