#include "model/audio/decode.h"

#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "model/audio/byte_source.h"
#include "model/audio/resample.h"
#include "model/audio/truncation.h"
#include "model/core/error.h"

namespace choreo {
namespace {

constexpr const char* kFormats = "WAV, FLAC, Ogg or MP3";

/// Of each channel, decoded at a time.
constexpr size_t kPieceSamples = 65536;

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

sf_count_t NoWrite(const void*, sf_count_t, void*) { return 0; }

/// Begins with an ID3 tag or the eleven set bits of a frame header.
bool LooksLikeMp3(const ByteSource& source) {
  std::array<std::byte, 3> head{};
  source.read_at(0, head);
  const bool is_tag = std::memcmp(head.data(), "ID3", 3) == 0;
  return is_tag || (head[0] == std::byte{0xff} && (head[1] & std::byte{0xe0}) == std::byte{0xe0});
}

bool IsReadableFormat(int format) {
  switch (format & SF_FORMAT_TYPEMASK) {
    case SF_FORMAT_WAV:
    case SF_FORMAT_WAVEX:
    case SF_FORMAT_RF64:
    case SF_FORMAT_FLAC:
    case SF_FORMAT_OGG:
    case SF_FORMAT_MPEG:
      return true;
    default:
      return false;
  }
}

struct CloseFile {
  void operator()(SNDFILE* file) const { sf_close(file); }
};

}  // namespace

struct AudioReader::State {
  std::string name;
  Cursor cursor{};
  SF_INFO info{};
  std::unique_ptr<SNDFILE, CloseFile> file;
  int64_t read = 0;  // samples of each channel so far

  int64_t limit() const { return int64_t{kMaxAudioSeconds} * info.samplerate; }
  /// Of `samples` of each channel.
  void CheckAmount(int64_t samples) const {
    if (samples > limit()) FailTooLong(samples);
    if (samples * info.channels <= kMaxFileSamples) return;
    throw InvalidArgument(name, std::to_string(samples * info.channels) + " samples or more (" +
                                    std::to_string(info.channels) + " channels at " +
                                    std::to_string(info.samplerate) + " Hz), at most " +
                                    std::to_string(kMaxFileSamples) + " are decoded");
  }
  [[noreturn]] void FailTooLong(int64_t samples) const {
    throw InvalidArgument(name, std::to_string(samples / info.samplerate) +
                                    " s or more of audio, at most " +
                                    std::to_string(kMaxAudioSeconds) + " s are taken");
  }
};

AudioReader::AudioReader(ByteSource source, std::string name) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.name = std::move(name);
  if (source.size == 0) throw InvalidArgument(s.name, "0 bytes of audio");
  CheckNotTruncated(source, s.name);
  s.cursor.can_seek_from_end = !LooksLikeMp3(source);
  s.cursor.source = std::move(source);
  SF_VIRTUAL_IO io{CursorSize, CursorSeek, CursorRead, NoWrite, CursorTell};
  s.file.reset(sf_open_virtual(&io, SFM_READ, &s.info, &s.cursor));
  if (!s.file) {
    throw InvalidArgument(s.name,
                          std::string("not ") + kFormats + " audio: " + sf_strerror(nullptr));
  }
  if (!IsReadableFormat(s.info.format)) {
    SF_FORMAT_INFO format{};
    format.format = s.info.format & SF_FORMAT_TYPEMASK;
    const bool known = sf_command(nullptr, SFC_GET_FORMAT_INFO, &format, sizeof(format)) == 0;
    throw InvalidArgument(
        s.name,
        std::string(known && format.name ? format.name : "another format") + " is not " + kFormats);
  }
  CheckAudioFormat(s.info.samplerate, s.info.channels, s.name);
  if (s.info.frames != SF_COUNT_MAX) s.CheckAmount(s.info.frames);
}

AudioReader::~AudioReader() = default;
AudioReader::AudioReader(AudioReader&&) noexcept = default;
AudioReader& AudioReader::operator=(AudioReader&&) noexcept = default;

AudioReader AudioReader::OpenFile(const std::filesystem::path& path) {
  return AudioReader(FileBytes(path), path.string());
}

AudioReader AudioReader::OpenMemory(std::span<const std::byte> bytes, const std::string& name) {
  return AudioReader(MemoryBytes(bytes), name);
}

int AudioReader::sample_rate() const { return state_->info.samplerate; }
int AudioReader::channels() const { return state_->info.channels; }

int64_t AudioReader::stated_samples() const {
  return state_->info.frames == SF_COUNT_MAX ? 0 : std::max<int64_t>(state_->info.frames, 0);
}

int64_t AudioReader::Read(std::span<float> interleaved) {
  State& s = *state_;
  const size_t channels_count = static_cast<size_t>(s.info.channels);
  if (interleaved.size() % channels_count != 0) {
    throw InvalidArgument("interleaved", std::to_string(interleaved.size()) +
                                             " samples are not a multiple of the " +
                                             std::to_string(channels_count) + " channels");
  }
  const int64_t wanted = static_cast<int64_t>(interleaved.size() / channels_count);
  const int64_t got = sf_readf_float(s.file.get(), interleaved.data(), wanted);
  if (const int error = sf_error(s.file.get()); error != SF_ERR_NO_ERROR) {
    throw InvalidArgument(s.name, "truncated or damaged after sample " +
                                      std::to_string(s.read + got) + ": " + sf_error_number(error));
  }
  CheckFinite(interleaved.first(static_cast<size_t>(got) * channels_count), s.info.channels, s.read,
              s.name);
  s.read += got;
  s.CheckAmount(s.read);
  if (got < wanted) {
    if (s.read == 0) throw InvalidArgument(s.name, "0 samples of audio");
    if (s.read < stated_samples()) {
      throw InvalidArgument(s.name, "truncated: " + std::to_string(s.read) + " of " +
                                        std::to_string(stated_samples()) + " samples");
    }
  }
  return got;
}

namespace {

DecodedAudio ReadAll(AudioReader reader, double seconds) {
  DecodedAudio audio;
  audio.sample_rate = reader.sample_rate();
  audio.channels = reader.channels();
  const size_t channels = static_cast<size_t>(audio.channels);
  const size_t block = kPieceSamples * channels;
  for (;;) {
    const size_t size = audio.interleaved.size();
    audio.interleaved.resize(size + block);
    const int64_t got = reader.Read(std::span(audio.interleaved).subspan(size));
    audio.interleaved.resize(size + static_cast<size_t>(got) * channels);
    if (got == 0 || audio.seconds() >= seconds) return audio;
  }
}

}  // namespace

DecodedAudio DecodeAudioFile(const std::filesystem::path& path, double seconds) {
  return ReadAll(AudioReader::OpenFile(path), seconds);
}

std::vector<float> ToModelRate(const DecodedAudio& audio) {
  Resampler resampler(audio.sample_rate, audio.channels);
  std::vector<float> mono;
  resampler.Push(audio.interleaved);
  resampler.Finish();
  resampler.Pull(mono);
  return mono;
}

std::vector<float> DecodeMono(AudioReader reader, const std::function<void()>& between) {
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
