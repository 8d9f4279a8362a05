#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/audio/sound_bytes.h"

namespace choreo {

/// A sound file, decoded piece by piece to the end of its bytes, whatever its header says. Errors
/// are Error(kInvalidArgument), whose field is the name that the reader was made with. Not
/// thread-safe.
class SoundReader {
 public:
  virtual ~SoundReader() = default;

  int sample_rate() const { return sample_rate_; }  ///< Hz
  int channels() const { return channels_; }

  /// Fills `interleaved`, whole frames, from its beginning; full scale is -1 to 1. Returns how many
  /// samples of each channel were read. 0: the end.
  virtual int64_t Read(std::span<float> interleaved) = 0;

  /// What a listener should know of the bytes, as "its header says 5 samples, 4 are there".
  /// Complete after the end.
  const std::vector<std::string>& notes() const { return notes_; }

 protected:
  int sample_rate_ = 0, channels_ = 0;
  std::vector<std::string> notes_;
};

using ReaderOf = std::function<std::unique_ptr<SoundReader>(const ByteSource& part)>;

/// Parts of a file that were joined: one is read after the other. Throws where they differ in
/// sample rate or channels. A part behind the first that can't be decoded is noted and left out.
std::unique_ptr<SoundReader> ReadOneAfterAnother(std::vector<ByteSource> parts, ReaderOf open,
                                                 const std::string& name);

// The formats. Each throws where the bytes are not such a file.
std::unique_ptr<SoundReader> ReadWav(const ByteSource& source, const std::string& name);
std::unique_ptr<SoundReader> ReadFlac(const ByteSource& source, const std::string& name);
std::unique_ptr<SoundReader> ReadOgg(const ByteSource& source, const std::string& name);
/// What is no frame of MPEG audio is passed over.
std::unique_ptr<SoundReader> ReadMpeg(const ByteSource& source, const std::string& name);

/// FLAC packets in an Ogg stream.
std::unique_ptr<SoundReader> ReadOggFlac(const ByteSource& source, const std::string& name);

/// Where an ID3v2 tag that begins at `at` ends, or `at` where there is none.
int64_t TagEnd(const ByteSource& source, int64_t at);

/// Whether frames of MPEG audio, layer 1 to 3, follow each other near the beginning.
bool LooksLikeMpeg(const ByteSource& source);

}  // namespace choreo
