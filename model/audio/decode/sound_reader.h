#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/audio/decode/sound_bytes.h"

namespace choreo {

/// Decodes a sound file piece by piece to the end of its data, even if its header disagrees. Errors
/// are Error(kInvalidArgument), whose field is the name passed to the reader's factory. Not
/// thread-safe.
class SoundReader {
 public:
  virtual ~SoundReader() = default;

  int sample_rate() const { return sample_rate_; }  ///< Hz
  int channels() const { return channels_; }

  /// Fills `interleaved` with whole frames; full scale is -1 to 1. Returns the number of samples
  /// read per channel, or 0 at the end.
  virtual int64_t Read(std::span<float> interleaved) = 0;

  /// Notes for users, such as "its header says 5 samples, 4 are there". Complete after the end.
  const std::vector<std::string>& notes() const { return notes_; }

 protected:
  int sample_rate_ = 0, channels_ = 0;
  std::vector<std::string> notes_;
};

using ReaderOf = std::function<std::unique_ptr<SoundReader>(const ByteSource& part)>;

/// Reads the concatenated parts of a file in turn. Throws if their sample rates or channels differ.
/// Notes and skips later parts that can't be decoded.
std::unique_ptr<SoundReader> ReadOneAfterAnother(std::vector<ByteSource> parts, ReaderOf open,
                                                 const std::string& name);

// One reader per format. Each throws if the bytes are not of its format.
std::unique_ptr<SoundReader> ReadWav(const ByteSource& source, const std::string& name);
std::unique_ptr<SoundReader> ReadFlac(const ByteSource& source, const std::string& name);
std::unique_ptr<SoundReader> ReadOgg(const ByteSource& source, const std::string& name);
/// Skips whatever is not an MPEG audio frame.
std::unique_ptr<SoundReader> ReadMpeg(const ByteSource& source, const std::string& name);

/// FLAC packets in an Ogg stream.
std::unique_ptr<SoundReader> ReadOggFlac(const ByteSource& source, const std::string& name);

/// The end of an ID3v2 tag that begins at `at`, or `at` if there is none.
int64_t TagEnd(const ByteSource& source, int64_t at);

/// Whether there are successive frames of MPEG audio, layer 1 to 3, near the beginning.
bool LooksLikeMpeg(const ByteSource& source);

}  // namespace choreo
