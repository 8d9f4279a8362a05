#include "model/audio/decode.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "model/audio/resample.h"
#include "model/audio/sound_reader.h"
#include "model/core/error.h"

namespace choreo {
namespace {

/// Samples per channel decoded at a time.
constexpr size_t kPieceSamples = 65536;

/// Limit for pipes: ten minutes in the widest accepted format.
constexpr int64_t kMostPipeBytes = 4 * kMaxFileSamples;

/// The name of a format that is not decoded here, or "".
std::string OtherFormat(const ByteSource& source) {
  if (source.Has(4, "ftyp")) return "MP4 (m4a, mov)";
  if (source.Has(0, "FORM")) return "AIFF";
  if (source.Has(0, "\x1a\x45\xdf\xa3")) return "Matroska (webm, mka)";
  if (source.Has(0, "\x30\x26\xb2\x75")) return "WMA";
  if (source.Has(0, "caff")) return "CAF";
  if (source.Has(0, ".snd")) return "AU";
  return "";
}

bool IsAdts(const ByteSource& source) {  // AAC: twelve set bits, then layer 0
  return (source.Word(0) & 0xf6ff) == 0xf0ff;
}

std::unique_ptr<SoundReader> Open(const ByteSource& source, const std::string& name) {
  if (source.size == 0) throw InvalidArgument(name, "0 bytes of audio");
  // Taggers put ID3 before what is no MP3, too.
  if (const int64_t sound = TagEnd(source, 0);
      sound > 0 && (source.Has(sound, "fLaC") || source.Has(sound, "OggS")))
    return Open(PartOf(source, sound, source.size), name);
  const bool is_wave = source.Has(8, "WAVE");
  if (is_wave && (source.Has(0, "RIFF") || source.Has(0, "RF64") || source.Has(0, "BW64") ||
                  source.Has(0, "RIFX")))
    return ReadWav(source, name);
  if (source.Has(0, "fLaC")) return ReadFlac(source, name);
  if (source.Has(0, "OggS")) return ReadOgg(source, name);
  std::string other = OtherFormat(source);
  if (other.empty() && IsAdts(source)) other = "AAC";
  if (other.empty() && LooksLikeMpeg(source)) return ReadMpeg(source, name);
  throw Error(ErrorCode::kInvalidArgument, name,
              (other.empty() ? "not " : other + " is not ") + std::string(kSoundFormats) +
                  " audio: " + kAskFfmpeg + " converts anything that ffmpeg reads");
}

/// Reads a sound file in pieces, within the limits of format.h.
class LimitedReader {
 public:
  /// `name` is the field of errors.
  LimitedReader(const ByteSource& source, std::string name)
      : name_(std::move(name)), reader_(Open(source, name_)) {
    CheckAudioFormat(reader_->sample_rate(), reader_->channels(), name_);
  }

  int sample_rate() const { return reader_->sample_rate(); }
  int channels() const { return reader_->channels(); }
  int64_t read() const { return read_; }
  const std::vector<std::string>& notes() const { return reader_->notes(); }

  /// As SoundReader; `is_kept`: whether these samples count towards the limits.
  int64_t Read(std::span<float> interleaved, bool is_kept) {
    const int64_t got = reader_->Read(interleaved);
    CheckFinite(interleaved.first(static_cast<size_t>(got * channels())), channels(), read_, name_);
    read_ += got;
    if (is_kept) kept_ += got;
    CheckAmount();
    if (got == 0 && read_ == 0) throw InvalidArgument(name_, "0 samples of audio");
    return got;
  }

 private:
  void CheckAmount() const {
    if (kept_ > int64_t{kMaxAudioSeconds} * sample_rate()) {
      throw InvalidArgument(
          name_, std::to_string(kept_ / sample_rate()) + " s or more of audio, at most " +
                     std::to_string(kMaxAudioSeconds) +
                     " s are accepted: choose a part of it (--song-start, --seconds)");
    }
    if (kept_ * channels() > kMaxFileSamples) {
      throw InvalidArgument(name_, std::to_string(kept_ * channels()) + " samples or more (" +
                                       std::to_string(channels()) + " channels at " +
                                       std::to_string(sample_rate()) + " Hz), at most " +
                                       std::to_string(kMaxFileSamples) + " are decoded");
    }
  }

  const std::string name_;
  std::unique_ptr<SoundReader> reader_;
  int64_t read_ = 0, kept_ = 0;  // samples per channel so far
};

/// Compares the power of the channels with that of their mix.
class Cancellation {
 public:
  void Hear(std::span<const float> interleaved, int channels) {
    const auto count = static_cast<size_t>(channels);
    for (size_t i = 0; i + count <= interleaved.size(); i += count) {
      double sum = 0;
      for (size_t c = 0; c < count; ++c) {
        sum += interleaved[i + c];
        alone_ += double{interleaved[i + c]} * interleaved[i + c] / channels;
      }
      together_ += sum * sum / (channels * channels);
    }
  }
  /// The mix has less than a thousandth of the channels' power.
  bool IsNearlyWhole() const { return together_ < 1e-3 * alone_; }

 private:
  double alone_ = 0, together_ = 0;
};

constexpr const char* kCancels =
    "its channels cancel each other (one is the other inverted); only the first is used";

std::vector<float> FirstChannel(std::span<const float> interleaved, int channels) {
  std::vector<float> first;
  for (size_t i = 0; i < interleaved.size(); i += static_cast<size_t>(channels))
    first.push_back(interleaved[i]);
  return first;
}

}  // namespace

DecodedAudio DecodeAudioFile(const std::filesystem::path& path, double seconds, double start) {
  const std::filesystem::path file = path == "-" ? "/dev/stdin" : path;
  LimitedReader reader(FileBytes(file, kMostPipeBytes), path.string());
  DecodedAudio audio{.sample_rate = reader.sample_rate(), .channels = reader.channels()};
  const size_t channels = static_cast<size_t>(audio.channels);
  const int64_t skipped = std::llround(start * audio.sample_rate);
  Cancellation cancellation;
  for (;;) {
    const int64_t left_out = std::min<int64_t>(skipped - reader.read(), kPieceSamples);
    const size_t size = audio.interleaved.size();
    const int64_t wanted = left_out > 0 ? left_out : static_cast<int64_t>(kPieceSamples);
    audio.interleaved.resize(size + static_cast<size_t>(wanted) * channels);
    const int64_t got = reader.Read(std::span(audio.interleaved).subspan(size), left_out <= 0);
    audio.interleaved.resize(size + (left_out > 0 ? 0 : static_cast<size_t>(got) * channels));
    cancellation.Hear(std::span(audio.interleaved).subspan(size), audio.channels);
    if (got == 0 || (left_out <= 0 && audio.seconds() >= seconds)) break;
  }
  audio.notes = reader.notes();
  audio.end_s = static_cast<double>(reader.read()) / audio.sample_rate;
  if (audio.channels > 1 && cancellation.IsNearlyWhole() && audio.samples() > 0) {
    audio.interleaved = FirstChannel(audio.interleaved, audio.channels);
    audio.channels = 1;
    audio.notes.push_back(kCancels);
  }
  return audio;
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
  std::vector<float> mono;
  for (const bool first_alone : {false, true}) {
    LimitedReader reader(MemoryBytes(bytes), "audio");
    const int channels = reader.channels();
    Resampler resampler(reader.sample_rate(), first_alone ? 1 : channels);
    std::vector<float> piece(kPieceSamples * static_cast<size_t>(channels));
    Cancellation cancellation;
    mono.clear();
    while (const int64_t got = reader.Read(piece, true)) {
      const auto read = std::span(piece).first(static_cast<size_t>(got * channels));
      cancellation.Hear(read, channels);
      if (first_alone) {
        resampler.Push(FirstChannel(read, channels));
      } else {
        resampler.Push(read);
      }
      resampler.Pull(mono);
      if (between) between();
    }
    resampler.Finish();
    resampler.Pull(mono);
    if (channels == 1 || !cancellation.IsNearlyWhole()) break;
  }
  return mono;
}

}  // namespace choreo
