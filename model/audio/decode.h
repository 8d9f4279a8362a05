#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "model/audio/format.h"

/// Sound files: WAV, FLAC, Ogg (Vorbis, Opus, FLAC) and MP3, also joined ones, within the limits of
/// format.h. They are decoded to the end of their bytes; where a header says something else, that
/// is noted. Errors are Error(kInvalidArgument), or kNotFound for a file that cannot be opened,
/// whose field begins with the path, or with "audio" for memory. Refused are what is not such audio
/// or beyond the limits, no samples, and samples that are NaN or infinite.
namespace choreo {

inline constexpr const char* kSoundFormats = "WAV, FLAC, Ogg or MP3";
/// What refusals of other formats say.
inline constexpr const char* kAskFfmpeg = "`ffmpeg -i FILE song.wav`";

struct DecodedAudio {
  std::vector<float> interleaved{};  ///< full scale is -1 to 1
  int sample_rate = 0;               ///< Hz
  int channels = 0;
  double end_s = 0;  ///< second of the file up to which it was read
  /// For people, in the file's order: "its header says 5 samples, 4 are there".
  std::vector<std::string> notes{};

  int64_t samples() const { return static_cast<int64_t>(interleaved.size()) / channels; }
  double seconds() const { return static_cast<double>(samples()) / sample_rate; }
};

/// A sound file from second `start` on (which may take a gigabyte), or `seconds` of it, rounded up
/// to whole pieces: what lies behind them is not read. Limits hold for what is kept. Nothing is
/// left where `start` lies behind the end. `-`: standard input; pipes are read to their end. Where
/// channels cancel each other, the first alone is given, with a note.
DecodedAudio DecodeAudioFile(const std::filesystem::path& path,
                             double seconds = std::numeric_limits<double>::infinity(),
                             double start = 0);

/// As mono samples at 22 050 Hz, the whole: what Mfcc, FindOnsets and FindBeats take.
std::vector<float> ToModelRate(const DecodedAudio& audio);

/// The same straight from the bytes of a file, decoded in pieces, so that no more is held than the
/// result (53 MB at most). The same bits. `between` is called between two pieces, some milliseconds
/// apart; what it throws ends the work.
std::vector<float> DecodeMono(std::span<const std::byte> bytes,
                              const std::function<void()>& between = {});

}  // namespace choreo
