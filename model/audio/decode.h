#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/audio/format.h"

namespace choreo {

struct ByteSource;

/// A sound file read in pieces: WAV, FLAC, Ogg (Vorbis, Opus) and MP3, within the limits of
/// format.h. Not thread-safe; readers of different files are independent. Errors are
/// Error(kInvalidArgument), or kNotFound for a file that cannot be opened, whose field begins with
/// the path, or the name given for memory. Refused are what is not such audio or beyond the limits,
/// no samples, samples that are NaN or infinite, and truncated files as far as the format tells.
class AudioReader {
 public:
  static AudioReader OpenFile(const std::filesystem::path& path);
  /// `bytes` must outlive the reader.
  static AudioReader OpenMemory(std::span<const std::byte> bytes,
                                const std::string& name = "audio");
  ~AudioReader();
  AudioReader(AudioReader&&) noexcept;
  AudioReader& operator=(AudioReader&&) noexcept;

  int sample_rate() const;  ///< Hz
  int channels() const;
  /// Samples (of each channel) as the header states them; 0 where it does not (MP3 without a
  /// Xing header).
  int64_t stated_samples() const;

  /// Fills `interleaved`, whose size is a multiple of channels(), from its beginning, and returns
  /// how many samples of each channel were read. 0: the end. Full scale is -1 to 1.
  int64_t Read(std::span<float> interleaved);

 private:
  struct State;
  AudioReader(ByteSource source, std::string name);

  std::unique_ptr<State> state_;
};

struct DecodedAudio {
  std::vector<float> interleaved;  ///< full scale is -1 to 1
  int sample_rate = 0;             ///< Hz
  int channels = 0;

  int64_t samples() const { return static_cast<int64_t>(interleaved.size()) / channels; }
  double seconds() const { return static_cast<double>(samples()) / sample_rate; }
};

/// All of a sound file at once (which may be a gigabyte), or its first `seconds`, rounded
/// up to whole pieces: what lies behind them is not read. Errors as AudioReader.
DecodedAudio DecodeAudioFile(const std::filesystem::path& path,
                             double seconds = std::numeric_limits<double>::infinity());

/// As mono samples at 22 050 Hz, the whole: what Mfcc, OnsetStrength and FindBeats take.
std::vector<float> ToModelRate(const DecodedAudio& audio);

/// The same straight from the file, decoded in pieces, so that no more is held than the result (53
/// MB at most). The same bits. Errors as AudioReader. `between` is called between two pieces, some
/// milliseconds apart; what it throws ends the work.
std::vector<float> DecodeMono(AudioReader reader, const std::function<void()>& between = {});

}  // namespace choreo
