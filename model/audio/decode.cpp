#include "model/audio/decode.h"

#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include "model/audio/resample.h"
#include "model/audio/truncation.h"
#include "model/core/error.h"

namespace choreo {
namespace {

constexpr const char* kFormats = "WAV, FLAC, Ogg or MP3";
constexpr int kReadable[] = {SF_FORMAT_WAV,  SF_FORMAT_WAVEX, SF_FORMAT_RF64,
                             SF_FORMAT_FLAC, SF_FORMAT_OGG,   SF_FORMAT_MPEG};

/// Of each channel, decoded at a time.
constexpr size_t kPieceSamples = 65536;

/// Throws Error(kNotFound), with the path as field, where the file cannot be opened.
ByteSource FileBytes(const std::filesystem::path& path) {
  const auto file = std::make_shared<std::ifstream>(path, std::ios::binary);
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (!*file || error) {
    throw Error(ErrorCode::kNotFound, path.string(), "cannot be opened as a file");
  }
  return {static_cast<int64_t>(size), [file](int64_t offset, std::span<std::byte> bytes) {
            file->clear();
            file->seekg(offset);
            file->read(reinterpret_cast<char*>(bytes.data()),
                       static_cast<std::streamsize>(bytes.size()));
            return static_cast<size_t>(std::max<std::streamsize>(file->gcount(), 0));
          }};
}

/// `memory` must outlive the source.
ByteSource MemoryBytes(std::span<const std::byte> memory) {
  const auto size = static_cast<int64_t>(memory.size());
  return {size, [memory, size](int64_t offset, std::span<std::byte> bytes) -> size_t {
            if (offset < 0 || offset >= size) return 0;
            const auto rest = memory.subspan(static_cast<size_t>(offset));
            const size_t count = std::min(rest.size(), bytes.size());
            std::copy_n(rest.begin(), count, bytes.begin());
            return count;
          }};
}

/// Where libsndfile is in a ByteSource.
struct Cursor {
  ByteSource source;
  /// Asked for the end of an MP3 file, libmpg123 guesses its length from the first frame's bit rate
  /// and libsndfile stops there: a song of varying bit rate and without a Xing header would lose
  /// its end. Unable to seek there, they read on to the last frame.
  bool can_seek_from_end = true;
  int64_t position = 0;
};

sf_count_t CursorSize(void* user) { return static_cast<Cursor*>(user)->source.size; }

sf_count_t CursorSeek(sf_count_t offset, int whence, void* user) {
  Cursor& cursor = *static_cast<Cursor*>(user);
  if (whence == SEEK_END && !cursor.can_seek_from_end) return -1;
  const int64_t base = whence == SEEK_SET   ? 0
                       : whence == SEEK_CUR ? cursor.position
                                            : cursor.source.size;
  if (base + offset < 0) return -1;
  return cursor.position = base + offset;
}

sf_count_t CursorRead(void* data, sf_count_t count, void* user) {
  Cursor& cursor = *static_cast<Cursor*>(user);
  const size_t read = cursor.source.read_at(
      cursor.position, {static_cast<std::byte*>(data), static_cast<size_t>(count)});
  cursor.position += static_cast<int64_t>(read);
  return static_cast<sf_count_t>(read);
}

sf_count_t CursorTell(void* user) { return static_cast<Cursor*>(user)->position; }

/// Begins with an ID3 tag or the eleven set bits of a frame header.
bool LooksLikeMp3(const ByteSource& source) {
  std::array<std::byte, 3> head{};
  source.read_at(0, head);
  const bool is_tag = std::memcmp(head.data(), "ID3", 3) == 0;
  return is_tag || (head[0] == std::byte{0xff} && (head[1] & std::byte{0xe0}) == std::byte{0xe0});
}

struct CloseFile {
  void operator()(SNDFILE* file) const { sf_close(file); }
};

/// A sound file read in pieces.
class AudioReader {
 public:
  /// `name` is the field of errors.
  AudioReader(ByteSource source, std::string name) : name_(std::move(name)) {
    if (source.size == 0) throw InvalidArgument(name_, "0 bytes of audio");
    CheckNotTruncated(source, name_);
    cursor_.can_seek_from_end = !LooksLikeMp3(source);
    cursor_.source = std::move(source);
    SF_VIRTUAL_IO io{CursorSize, CursorSeek, CursorRead, nullptr, CursorTell};
    file_.reset(sf_open_virtual(&io, SFM_READ, &info_, &cursor_));
    if (!file_) {
      throw InvalidArgument(name_,
                            std::string("not ") + kFormats + " audio: " + sf_strerror(nullptr));
    }
    SF_FORMAT_INFO format{};
    format.format = info_.format & SF_FORMAT_TYPEMASK;
    if (std::ranges::find(kReadable, format.format) == std::end(kReadable)) {
      const bool known = sf_command(nullptr, SFC_GET_FORMAT_INFO, &format, sizeof(format)) == 0;
      throw InvalidArgument(
          name_, std::string(known && format.name ? format.name : "another format") + " is not " +
                     kFormats);
    }
    CheckAudioFormat(sample_rate(), channels(), name_);
    if (info_.frames == SF_COUNT_MAX) info_.frames = 0;  // not stated: MP3 without a Xing header
    CheckAmount(info_.frames);
  }
  AudioReader(const AudioReader&) = delete;  // libsndfile holds on to the cursor
  AudioReader& operator=(const AudioReader&) = delete;

  int sample_rate() const { return info_.samplerate; }
  int channels() const { return info_.channels; }

  /// Fills `interleaved`, whole frames, from its beginning, and returns how many samples of each
  /// channel were read. 0: the end.
  int64_t Read(std::span<float> interleaved) {
    const size_t channels_count = static_cast<size_t>(channels());
    const int64_t wanted = static_cast<int64_t>(interleaved.size() / channels_count);
    const int64_t got = sf_readf_float(file_.get(), interleaved.data(), wanted);
    if (const int error = sf_error(file_.get()); error != SF_ERR_NO_ERROR) {
      throw InvalidArgument(name_, "truncated or damaged after sample " +
                                       std::to_string(read_ + got) + ": " + sf_error_number(error));
    }
    CheckFinite(interleaved.first(static_cast<size_t>(got) * channels_count), channels(), read_,
                name_);
    read_ += got;
    CheckAmount(read_);
    if (got < wanted) {
      if (read_ == 0) throw InvalidArgument(name_, "0 samples of audio");
      if (read_ < info_.frames) {
        throw InvalidArgument(name_, "truncated: " + std::to_string(read_) + " of " +
                                         std::to_string(info_.frames) + " samples");
      }
    }
    return got;
  }

 private:
  /// Of `samples` of each channel.
  void CheckAmount(int64_t samples) const {
    if (samples > int64_t{kMaxAudioSeconds} * sample_rate()) {
      throw InvalidArgument(name_, std::to_string(samples / sample_rate()) +
                                       " s or more of audio, at most " +
                                       std::to_string(kMaxAudioSeconds) + " s are taken");
    }
    if (samples * channels() > kMaxFileSamples) {
      throw InvalidArgument(name_, std::to_string(samples * channels()) + " samples or more (" +
                                       std::to_string(channels()) + " channels at " +
                                       std::to_string(sample_rate()) + " Hz), at most " +
                                       std::to_string(kMaxFileSamples) + " are decoded");
    }
  }

  const std::string name_;
  Cursor cursor_{};
  SF_INFO info_{};  // its `frames` are those that the header states, or 0
  std::unique_ptr<SNDFILE, CloseFile> file_;
  int64_t read_ = 0;  // samples of each channel so far
};

}  // namespace

DecodedAudio DecodeAudioFile(const std::filesystem::path& path, double seconds) {
  AudioReader reader(FileBytes(path), path.string());
  DecodedAudio audio{
      .interleaved = {}, .sample_rate = reader.sample_rate(), .channels = reader.channels()};
  const size_t channels = static_cast<size_t>(audio.channels);
  for (;;) {
    const size_t size = audio.interleaved.size();
    audio.interleaved.resize(size + kPieceSamples * channels);
    const int64_t got = reader.Read(std::span(audio.interleaved).subspan(size));
    audio.interleaved.resize(size + static_cast<size_t>(got) * channels);
    if (got == 0 || audio.seconds() >= seconds) return audio;
  }
}

std::vector<float> ToModelRate(const DecodedAudio& audio) {
  Resampler resampler(audio.sample_rate, audio.channels);
  std::vector<float> mono;
  resampler.Push(audio.interleaved);
  resampler.Finish();
  resampler.Pull(mono);
  return mono;
}

std::vector<float> DecodeMono(std::span<const std::byte> bytes,
                              const std::function<void()>& between) {
  AudioReader reader(MemoryBytes(bytes), "audio");
  Resampler resampler(reader.sample_rate(), reader.channels());
  const size_t channels = static_cast<size_t>(reader.channels());
  std::vector<float> piece(kPieceSamples * channels);
  std::vector<float> mono;
  while (const int64_t got = reader.Read(piece)) {
    resampler.Push(std::span(piece).first(static_cast<size_t>(got) * channels));
    resampler.Pull(mono);
    if (between) between();
  }
  resampler.Finish();
  resampler.Pull(mono);
  return mono;
}

}  // namespace choreo
