#include <mpg123.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "model/audio/decode/decode.h"
#include "model/audio/decode/sound_reader.h"
#include "model/core/error.h"

namespace choreo {
namespace {

// Explains a refusal: bytes of other formats can look like MP3 frames.
Error NoMpeg(const std::string& name, const std::string& why) {
  return Error(ErrorCode::kInvalidArgument, name,
               "not MP3 audio, " + why + ": " + kAskFfmpeg + " converts anything that ffmpeg reads",
               Remedy::kConvert);
}

constexpr int64_t kSearched = 1 << 17;  // the first frame must begin within this many bytes

/// An MPEG audio frame, decoded from its four header bytes.
struct Frame {
  int version = 0, layer = 0, sample_rate = 0;
  int64_t bytes = 0;
  int64_t info_at = 0;  // offset of an encoder's tag in the first frame of a file

  bool IsLike(const Frame& other) const {
    return version == other.version && layer == other.layer && sample_rate == other.sample_rate;
  }
};

std::optional<Frame> FrameAt(const ByteSource& source, int64_t at) {
  static constexpr std::array<int, 3> kRates{44100, 48000, 32000};
  // kbit/s: [layer 1, 2, 3 of MPEG 1; layer 1, 2 and 3 of MPEG 2]
  static constexpr std::array<std::array<int, 15>, 5> kBits{
      {{0, 32, 64, 96, 128, 160, 192, 224, 256, 288, 320, 352, 384, 416, 448},
       {0, 32, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320, 384},
       {0, 32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320},
       {0, 32, 48, 56, 64, 80, 96, 112, 128, 144, 160, 176, 192, 224, 256},
       {0, 8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160}}};
  std::array<std::byte, 4> bytes{};
  if (source.read_at(at, bytes) < bytes.size()) return std::nullopt;
  const auto b = [&](size_t i) { return std::to_integer<unsigned>(bytes[i]); };
  if (b(0) != 0xff || (b(1) & 0xe0) != 0xe0) return std::nullopt;
  const unsigned version = (b(1) >> 3) & 3, layer = 4 - ((b(1) >> 1) & 3);
  const unsigned bits = b(2) >> 4, rate = (b(2) >> 2) & 3, padding = (b(2) >> 1) & 1;
  if (version == 1 || layer == 4 || bits == 0 || bits == 15 || rate == 3) return std::nullopt;
  const bool is_first = version == 3;
  Frame frame;
  frame.version = static_cast<int>(version);
  frame.layer = static_cast<int>(layer);
  frame.sample_rate = kRates[rate] >> (is_first ? 0 : version == 2 ? 1 : 2);
  const int kbits = kBits[is_first ? layer - 1 : layer == 1 ? 3 : 4][bits];
  const int samples = layer == 1 ? 384 : layer == 3 && !is_first ? 576 : 1152;
  const int slot = layer == 1 ? 4 : 1;
  frame.bytes = (int64_t{samples} / 8 * kbits * 1000 / frame.sample_rate / slot + padding) * slot;
  const bool is_mono = (b(3) >> 6) == 3;
  frame.info_at = is_first ? (is_mono ? 21 : 36) : (is_mono ? 13 : 21);
  return frame;
}

/// A frame followed by two of its kind.
std::optional<Frame> SyncAt(const ByteSource& source, int64_t at) {
  const std::optional<Frame> frame = FrameAt(source, at);
  if (!frame) return std::nullopt;
  int64_t next = at + frame->bytes;
  for (int i = 0; i < 2 && next < source.size; ++i) {
    const std::optional<Frame> other = FrameAt(source, next);
    if (!other || !other->IsLike(*frame)) return std::nullopt;
    next += other->bytes;
  }
  return frame;
}

std::optional<int64_t> FindSync(const ByteSource& source, int64_t from, int64_t to) {
  std::array<std::byte, 4096> piece;
  for (int64_t at = from; at < to; at += std::ssize(piece)) {
    const auto read = static_cast<int64_t>(source.read_at(at, piece));
    for (int64_t i = 0; i < read && at + i < to; ++i) {
      if (piece[static_cast<size_t>(i)] == std::byte{0xff} && SyncAt(source, at + i)) return at + i;
    }
    if (read < std::ssize(piece)) break;
  }
  return std::nullopt;
}

/// The first sync at or after `at`, past the tag that begins there if its length leads to one: a
/// tag may contain sound.
std::optional<int64_t> FindSyncAfterTag(const ByteSource& source, int64_t at) {
  const int64_t end = TagEnd(source, at);
  if (end > at && end < source.size) {
    if (const auto found = FindSync(source, end, std::min(end + kSearched, source.size)))
      return found;
  }
  return FindSync(source, at, source.size);
}

/// Frames that were encoded together: from one encoder's tag to the next.
struct Stretch {
  int64_t begin = 0, end = 0;
  int64_t frames = 0;             // without the tag's own
  std::optional<int64_t> stated;  // by the tag
  int64_t delay = 0;              // samples of silence before the song, by the tag
};

/// The number of frames that an encoder's tag in this one promises.
std::optional<int64_t> StatedIn(const ByteSource& source, int64_t at, const Frame& frame) {
  const int64_t tag = at + frame.info_at;
  if (!source.Has(tag, "Xing") && !source.Has(tag, "Info")) return std::nullopt;
  const uint32_t flags = __builtin_bswap32(source.Word(tag + 4));
  return flags & 1 ? int64_t{__builtin_bswap32(source.Word(tag + 8))} : 0;
}

/// The samples that encoder and decoder put before the song, by the encoder's part of a tag; 0 if
/// it has none.
int64_t DelayIn(const ByteSource& source, int64_t at, const Frame& frame) {
  constexpr int64_t kDecoderDelay = 529;
  const int64_t tag = at + frame.info_at;
  const uint32_t flags = __builtin_bswap32(source.Word(tag + 4));
  const int64_t encoder = tag + 8 + (flags & 1 ? 4 : 0) + (flags & 2 ? 4 : 0) +
                          (flags & 4 ? 100 : 0) + (flags & 8 ? 4 : 0);
  if ((source.Word(encoder) & 0xff) == 0) return 0;
  return kDecoderDelay + (__builtin_bswap32(source.Word(encoder + 21)) >> 20);
}

struct Walk {
  std::vector<Stretch> stretches;
  int64_t left_out = 0;  // bytes that are neither frames nor tags
};

Walk WalkFrames(const ByteSource& source) {
  Walk walk;
  std::optional<int64_t> at = FindSyncAfterTag(source, 0);
  if (at) walk.left_out = *at;
  if (at && source.Has(0, "ID3")) walk.left_out = 0;
  while (at && *at < source.size) {
    const std::optional<Frame> frame = FrameAt(source, *at);
    if (!frame) {
      const bool is_tag = source.Has(*at, "TAG") || source.Has(*at, "ID3") ||
                          source.Has(*at, "APETAGEX") || source.Has(*at, "LYRICSBEGIN");
      const std::optional<int64_t> next = source.Has(*at, "ID3")
                                              ? FindSyncAfterTag(source, *at)
                                              : FindSync(source, *at + 1, source.size);
      if (!is_tag) walk.left_out += next.value_or(source.size) - *at;
      at = next;
      continue;
    }
    constexpr int64_t kVbri = 36;
    if (source.Has(*at + kVbri, "VBRI")) {  // another encoder's tag, in a frame that is no sound
      *at += frame->bytes;
      walk.stretches.push_back({.begin = *at, .end = *at, .stated = {}});
      continue;
    }
    const std::optional<int64_t> stated = StatedIn(source, *at, *frame);
    if (walk.stretches.empty() || stated)
      walk.stretches.push_back(
          {.begin = *at, .stated = stated, .delay = stated ? DelayIn(source, *at, *frame) : 0});
    Stretch& stretch = walk.stretches.back();
    if (!stated) ++stretch.frames;
    *at += frame->bytes;
    stretch.end = std::min(*at, source.size);
  }
  return walk;
}

class StretchReader final : public SoundReader {
 public:
  StretchReader(ByteSource source, const Stretch& stretch, const std::string& name)
      : name_(name), source_(std::move(source)) {
    static const int ready = mpg123_init();
    (void)ready;
    decoder_.reset(mpg123_new(nullptr, nullptr));
    if (!decoder_) throw Error(ErrorCode::kInternal, name_, "no MP3 decoder");
    mpg123_param(decoder_.get(), MPG123_ADD_FLAGS, MPG123_FORCE_FLOAT | MPG123_QUIET, 0);
    mpg123_param(decoder_.get(), MPG123_RESYNC_LIMIT, -1, 0);
    // A tag says how much silence the encoder added at both ends. A tag that counts too few frames
    // would cut the song short, but states the silence before it correctly.
    const bool is_right = stretch.stated && *stretch.stated >= stretch.frames;
    mpg123_param(decoder_.get(), is_right ? MPG123_ADD_FLAGS : MPG123_REMOVE_FLAGS, MPG123_GAPLESS,
                 0);
    if (mpg123_open_feed(decoder_.get()) != MPG123_OK || !Decode())
      throw NoMpeg(name_, "no frame of it can be decoded");
    if (!is_right) Skip(stretch.delay);
    if (stretch.stated && *stretch.stated > 0 && *stretch.stated != stretch.frames)
      notes_.push_back("its header says " + std::to_string(*stretch.stated) + " frames, " +
                       std::to_string(stretch.frames) + " are there");
  }

  int64_t Read(std::span<float> interleaved) override {
    const size_t wanted = interleaved.size() - interleaved.size() % static_cast<size_t>(channels_);
    size_t count = 0;
    while (count < wanted) {
      if (taken_ == decoded_.size() && !Decode()) break;
      const size_t part = std::min(wanted - count, decoded_.size() - taken_);
      std::copy_n(decoded_.begin() + static_cast<std::ptrdiff_t>(taken_), part,
                  interleaved.begin() + static_cast<std::ptrdiff_t>(count));
      count += part;
      taken_ += part;
    }
    return static_cast<int64_t>(count) / channels_;
  }

 private:
  struct Delete {
    void operator()(mpg123_handle* handle) const { mpg123_delete(handle); }
  };

  void Skip(int64_t samples) {
    for (size_t left = static_cast<size_t>(samples * channels_); left > 0;) {
      const size_t part = std::min(left, decoded_.size() - taken_);
      taken_ += part;
      left -= part;
      if (left > 0 && !Decode()) return;
    }
  }

  /// Refills decoded_; false at the end.
  bool Decode() {
    decoded_.resize(1 << 14);
    taken_ = 0;
    for (;;) {
      size_t bytes = 0;
      const int result =
          mpg123_read(decoder_.get(), reinterpret_cast<unsigned char*>(decoded_.data()),
                      decoded_.size() * sizeof(float), &bytes);
      if (result == MPG123_NEW_FORMAT) TakeFormat();
      if (bytes > 0) {
        decoded_.resize(bytes / sizeof(float));
        return true;
      }
      if (result == MPG123_NEED_MORE) {
        std::array<std::byte, 1 << 15> piece;
        const size_t read = source_.read_at(position_, piece);
        position_ += static_cast<int64_t>(read);
        if (read == 0 || mpg123_feed(decoder_.get(), reinterpret_cast<unsigned char*>(piece.data()),
                                     read) != MPG123_OK)
          break;
      } else if (result != MPG123_OK && result != MPG123_NEW_FORMAT) {
        break;
      }
    }
    decoded_.clear();
    return false;
  }

  void TakeFormat() {
    long rate = 0;
    int channels = 0, encoding = 0;
    mpg123_getformat(decoder_.get(), &rate, &channels, &encoding);
    if (sample_rate_ != 0 && (rate != sample_rate_ || channels != channels_)) {
      throw Error(ErrorCode::kInvalidArgument, name_,
                  "changes from " + std::to_string(channels_) + " channels at " +
                      std::to_string(sample_rate_) + " Hz to " + std::to_string(channels) + " at " +
                      std::to_string(rate) + ": " + kAskFfmpeg + " converts it to one format",
                  Remedy::kConvert);
    }
    sample_rate_ = static_cast<int>(rate);
    channels_ = channels;
  }

  const std::string name_;
  ByteSource source_;
  int64_t position_ = 0;
  std::unique_ptr<mpg123_handle, Delete> decoder_;
  std::vector<float> decoded_;
  size_t taken_ = 0;
};

/// Notes how many bytes it skipped.
class MpegReader final : public SoundReader {
 public:
  MpegReader(std::unique_ptr<SoundReader> reader, int64_t left_out)
      : reader_(std::move(reader)), left_out_(left_out) {
    sample_rate_ = reader_->sample_rate();
    channels_ = reader_->channels();
  }
  int64_t Read(std::span<float> interleaved) override {
    const int64_t count = reader_->Read(interleaved);
    if (count == 0) {
      notes_ = reader_->notes();
      if (left_out_ > 0)
        notes_.push_back(std::to_string(left_out_) + " bytes of it are not MP3 and are skipped");
    }
    return count;
  }

 private:
  std::unique_ptr<SoundReader> reader_;
  int64_t left_out_;
};

}  // namespace

// Four bytes of seven bits hold its length, not counting the ten bytes of its header.
int64_t TagEnd(const ByteSource& source, int64_t at) {
  if (!source.Has(at, "ID3")) return at;
  const uint32_t size = __builtin_bswap32(source.Word(at + 6));
  return at + 10 +
         (int64_t{size & 0x7f} | int64_t{(size & 0x7f00) >> 1} | int64_t{(size & 0x7f0000) >> 2} |
          int64_t{(size & 0x7f000000) >> 3});
}

bool LooksLikeMpeg(const ByteSource& source) {
  return FindSync(source, 0, std::min(TagEnd(source, 0) + kSearched, source.size)).has_value();
}

std::unique_ptr<SoundReader> ReadMpeg(const ByteSource& source, const std::string& name) {
  const Walk walk = WalkFrames(source);
  std::vector<ByteSource> parts;
  for (const Stretch& stretch : walk.stretches)
    parts.push_back(PartOf(source, stretch.begin, stretch.end));
  if (parts.empty()) throw NoMpeg(name, "it has no frame");
  size_t next = 0;
  auto reader = ReadOneAfterAnother(
      std::move(parts),
      [stretches = walk.stretches, name, next](const ByteSource& part) mutable {
        return std::make_unique<StretchReader>(part, stretches[next++], name);
      },
      name);
  return std::make_unique<MpegReader>(std::move(reader), walk.left_out);
}

}  // namespace choreo
