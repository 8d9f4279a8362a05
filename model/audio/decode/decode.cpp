#include "model/audio/decode/decode.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "model/audio/decode/sound_reader.h"
#include "model/audio/signal/resampler.h"
#include "model/core/error.h"

namespace choreo {
namespace {

/// Samples per channel decoded at a time.
constexpr size_t kPieceSamples = 65536;

/// Limit for pipes: ten minutes in the widest accepted format.
constexpr int64_t kMaxPipeBytes = 4 * kMaxFileSamples;

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

/// A server may send a page or a playlist in place of a song: ffmpeg takes that for a voice.
bool IsText(const ByteSource& source) {
  constexpr int64_t kRead = 4096, kAscii = 64;  // silence in mu-law has bytes of letters, too
  std::string begin(static_cast<size_t>(std::min(source.size, kRead)), '\0');
  source.read_at(0, std::as_writable_bytes(std::span(begin)));
  if (begin.starts_with("\xef\xbb\xbf")) begin.erase(0, 3);
  const auto is_control = [](char c) {
    return (c >= '\0' && c < ' ' && c != '\t' && c != '\r' && c != '\n') || c == '\x7f';
  };
  return std::ranges::none_of(begin, is_control) &&
         std::ranges::all_of(begin.substr(0, kAscii), [](char c) { return c > '\0'; });
}

std::unique_ptr<SoundReader> Open(const ByteSource& source, const std::string& name) {
  if (source.size == 0) throw InvalidArgument(name, "0 bytes of audio");
  // Some taggers put ID3 before other formats than MP3, too.
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
  if (IsText(source))
    throw InvalidArgument(name, std::string("not ") + kSoundFormats +
                                    " audio but text, such as a web page or a list of songs");
  throw Error(ErrorCode::kInvalidArgument, name,
              (other.empty() ? "not " : other + " is not ") + std::string(kSoundFormats) +
                  " audio: " + kAskFfmpeg + " converts anything that ffmpeg reads",
              Remedy::kConvert);
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
  /// The most samples per channel that may be kept.
  int64_t most() const {
    return std::min(int64_t{kMaxAudioSeconds} * sample_rate(), kMaxFileSamples / channels());
  }
  const std::vector<std::string>& notes() const { return reader_->notes(); }

  /// Reads like SoundReader; `is_kept`: whether these samples count towards the limits.
  int64_t Read(std::span<float> interleaved, bool is_kept) {
    const int64_t got = reader_->Read(interleaved);
    CheckLevels(interleaved.first(static_cast<size_t>(got * channels())), channels(), read_,
                name_ + ".data");
    read_ += got;
    if (is_kept) kept_ += got;
    CheckAmount();
    if (got == 0 && read_ == 0) throw InvalidArgument(name_, "0 samples of audio");
    return got;
  }

 private:
  void CheckAmount() const {
    if (kept_ > int64_t{kMaxAudioSeconds} * sample_rate()) {
      throw Error(ErrorCode::kInvalidArgument, name_,
                  std::to_string(kept_ / sample_rate()) + " s or more of audio, at most " +
                      std::to_string(kMaxAudioSeconds) + " s are accepted: choose a part of it",
                  Remedy::kTakePart);
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

/// Share of the power that the mix of unrelated channels would have. Below it the mix of two has
/// lost 6 dB against the channels (they correlate by less than -0.5): much of what people hear from
/// loudspeakers is missing from it.
constexpr double kCancelled = 0.5;
/// A later channel must be this much louder to be heard, so that channels do not take turns.
constexpr double kClearlyLouder = 1.1;

/// Whether channels cancel each other in these samples, whatever their DC offsets; then all become
/// the loudest.
bool MendCancelled(std::span<float> interleaved, int channels) {
  const auto count = static_cast<size_t>(channels);
  const auto samples = static_cast<double>(interleaved.size() / count);
  std::vector<double> sums(count), squares(count);
  double mixed = 0, mixed_squares = 0;
  for (size_t i = 0; i + count <= interleaved.size(); i += count) {
    double mix = 0;
    for (size_t c = 0; c < count; ++c) {
      const double sample = interleaved[i + c];
      sums[c] += sample;
      squares[c] += sample * sample;
      mix += sample / channels;
    }
    mixed += mix;
    mixed_squares += mix * mix;
  }
  double alone = 0;
  std::vector<double> powers(count);
  for (size_t c = 0; c < count; ++c) {
    powers[c] = squares[c] - sums[c] * sums[c] / samples;
    alone += powers[c] / channels;
  }
  const double unrelated = alone / channels;
  if (alone <= 1e-12 * samples || mixed_squares - mixed * mixed / samples >= kCancelled * unrelated)
    return false;
  size_t loudest = 0;
  for (size_t c = 1; c < count; ++c) {
    if (powers[c] > kClearlyLouder * powers[loudest]) loudest = c;
  }
  for (size_t i = 0; i < interleaved.size(); ++i)
    interleaved[i] = interleaved[i - i % count + loudest];
  return true;
}

}  // namespace

DecodedAudio DecodeAudioFile(const std::filesystem::path& path, double seconds, double start,
                             double more) {
  const std::filesystem::path file = path == "-" ? "/dev/stdin" : path;
  LimitedReader reader(FileBytes(file, kMaxPipeBytes), path.string());
  DecodedAudio audio{.sample_rate = reader.sample_rate(), .channels = reader.channels()};
  const size_t channels = static_cast<size_t>(audio.channels);
  const int64_t skipped = std::llround(start * audio.sample_rate);
  const bool stops = more > 0 && seconds * audio.sample_rate <= static_cast<double>(reader.most());
  for (;;) {
    const int64_t left_out = std::min<int64_t>(skipped - reader.read(), kPieceSamples);
    const size_t size = audio.interleaved.size();
    int64_t wanted = left_out > 0 ? left_out : static_cast<int64_t>(kPieceSamples);
    if (stops) wanted = std::min(wanted, reader.most() - audio.samples());
    audio.interleaved.resize(size + static_cast<size_t>(wanted) * channels);
    const int64_t got = reader.Read(std::span(audio.interleaved).subspan(size), left_out <= 0);
    audio.interleaved.resize(size + (left_out > 0 ? 0 : static_cast<size_t>(got) * channels));
    if (got == 0 || (left_out <= 0 && audio.seconds() >= seconds + more)) break;
  }
  audio.notes = reader.notes();
  audio.end_s = static_cast<double>(reader.read()) / audio.sample_rate;
  const size_t second = static_cast<size_t>(audio.sample_rate) * channels;
  size_t cancelled = 0, heard = 0;
  for (size_t at = 0; at < audio.interleaved.size(); at += second, ++heard) {
    const auto part = std::span(audio.interleaved).subspan(at);
    if (MendCancelled(part.first(std::min(second, part.size())), audio.channels)) ++cancelled;
  }
  if (cancelled > 0) {
    audio.notes.push_back("its channels cancel each other, in part or all, in " +
                          std::to_string(cancelled) + " of " + std::to_string(heard) +
                          " s; there only the louder one is used");
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
                              const std::function<void()>& between,
                              std::vector<std::string>* notes) {
  LimitedReader reader(MemoryBytes(bytes), "audio");
  const auto channels = static_cast<size_t>(reader.channels());
  Resampler resampler(reader.sample_rate(), reader.channels());
  std::vector<float> second(static_cast<size_t>(reader.sample_rate()) * channels), mono;
  for (size_t filled = second.size(); filled == second.size(); resampler.Pull(mono)) {
    filled = 0;
    while (filled < second.size()) {
      const auto room = std::span(second).subspan(filled);
      const int64_t got =
          reader.Read(room.first(std::min(room.size(), kPieceSamples * channels)), true);
      if (got == 0) break;
      filled += static_cast<size_t>(got) * channels;
      if (between) between();
    }
    const auto heard = std::span(second).first(filled);
    MendCancelled(heard, reader.channels());
    resampler.Push(heard);
  }
  resampler.Finish();
  resampler.Pull(mono);
  if (notes != nullptr) *notes = reader.notes();
  return mono;
}

}  // namespace choreo
