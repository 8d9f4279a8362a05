#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "model/audio/signal/format.h"

/// Decodes sound files: WAV, FLAC, Ogg (Vorbis, Opus, FLAC) and MP3, also concatenated ones, within
/// the limits of format.h. Decodes to the end of the data and notes where a header disagrees.
/// Errors: Error(kInvalidArgument), or kNotFound if a file cannot be opened; the field begins with
/// the path, or with "audio" for memory. Refuses other formats, files beyond the limits, files
/// without samples, and NaN or infinite samples.
namespace choreo {

inline constexpr const char* kSoundFormats = "WAV, FLAC, Ogg or MP3";
/// The advice in error messages about other formats.
inline constexpr const char* kAskFfmpeg = "`ffmpeg -i FILE song.wav`";

struct DecodedAudio {
  std::vector<float> interleaved{};  ///< full scale is -1 to 1
  int sample_rate = 0;               ///< Hz
  int channels = 0;
  double end_s = 0;  ///< position in the file where reading stopped, seconds
  /// Notes for users, in the file's order: "its header says 5 samples, 4 are there".
  std::vector<std::string> notes{};

  int64_t samples() const { return static_cast<int64_t>(interleaved.size()) / channels; }
  double seconds() const { return static_cast<double>(samples()) / sample_rate; }
};

/// Decodes `seconds` of a sound file from `start` on, rounded up to whole pieces, and `more`
/// seconds after them as far as the limits allow. Seeks past up to a gigabyte, and does not read
/// the rest. Limits apply to the decoded samples. Returns no samples if `start` is beyond the end.
/// `-` reads standard input; pipes are read to their end. In seconds where channels cancel each
/// other by 6 dB or more, the loudest replaces all, with a note.
DecodedAudio DecodeAudioFile(const std::filesystem::path& path,
                             double seconds = std::numeric_limits<double>::infinity(),
                             double start = 0, double more = 0);

/// Converts audio to mono samples at 22 050 Hz, the input of Mfcc, FindOnsets and FindBeats.
std::vector<float> ToModelRate(const DecodedAudio& audio);

/// Decodes a file's bytes to the same samples, bit for bit. Works in pieces, so memory holds only
/// the result (53 MB at most). Calls `between` between pieces, every few milliseconds; an exception
/// from it ends the work. `notes`, if given, receives where the file is damaged, ends early, or
/// disagrees with its header.
std::vector<float> DecodeMono(std::span<const std::byte> bytes,
                              const std::function<void()>& between = {},
                              std::vector<std::string>* notes = nullptr);

}  // namespace choreo
