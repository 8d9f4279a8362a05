#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "model/audio/format.h"

/// Sound files: WAV, FLAC, Ogg (Vorbis, Opus) and MP3, within the limits of format.h. Errors are
/// Error(kInvalidArgument), or kNotFound for a file that cannot be opened, whose field begins with
/// the path, or with "audio" for memory. Refused are what is not such audio or beyond the limits,
/// no samples, samples that are NaN or infinite, and truncated files as far as the format tells.
namespace choreo {

struct DecodedAudio {
  std::vector<float> interleaved;  ///< full scale is -1 to 1
  int sample_rate = 0;             ///< Hz
  int channels = 0;

  int64_t samples() const { return static_cast<int64_t>(interleaved.size()) / channels; }
  double seconds() const { return static_cast<double>(samples()) / sample_rate; }
};

/// All of a sound file at once (which may be a gigabyte), or its first `seconds`, rounded up to
/// whole pieces: what lies behind them is not read.
DecodedAudio DecodeAudioFile(const std::filesystem::path& path,
                             double seconds = std::numeric_limits<double>::infinity());

/// As mono samples at 22 050 Hz, the whole: what Mfcc, OnsetStrength and FindBeats take.
std::vector<float> ToModelRate(const DecodedAudio& audio);

/// The same straight from the bytes of a file, decoded in pieces, so that no more is held than the
/// result (53 MB at most). The same bits. `between` is called between two pieces, some milliseconds
/// apart; what it throws ends the work.
std::vector<float> DecodeMono(std::span<const std::byte> bytes,
                              const std::function<void()>& between = {});

}  // namespace choreo
