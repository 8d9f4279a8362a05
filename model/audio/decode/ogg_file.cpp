#include <opus/opusfile.h>
#include <vorbis/vorbisfile.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "model/audio/decode/decode.h"
#include "model/audio/decode/sound_reader.h"
#include "model/core/error.h"

namespace choreo {
namespace {

/// A byte stream without seeking, as the C libraries read it.
struct Stream {
  ByteSource source;
  int64_t position = 0;

  size_t Read(void* to, size_t bytes) {
    const size_t read = source.read_at(position, {static_cast<std::byte*>(to), bytes});
    position += static_cast<int64_t>(read);
    return read;
  }
};

/// An Ogg page: "OggS", version, flags (1: first page, 2: last page), position 8, serial 4, number
/// 4, checksum 4, number of segments, their lengths, the segments.
struct Page {
  static constexpr int64_t kHeader = 27;
  int64_t begin = 0, body = 0, end = 0;
  bool is_first = false, is_last = false;
};

std::optional<Page> PageAt(const ByteSource& source, int64_t at) {
  std::array<std::byte, Page::kHeader + 255> head{};
  const auto read = static_cast<int64_t>(source.read_at(at, head));
  if (read < Page::kHeader || !source.Has(at, "OggS")) return std::nullopt;
  const auto flags = std::to_integer<int>(head[5]);
  const auto segments = std::to_integer<int64_t>(head[Page::kHeader - 1]);
  Page page{at, at + Page::kHeader + segments, 0, (flags & 2) != 0, (flags & 4) != 0};
  page.end = page.body;
  for (int64_t i = 0; i < segments; ++i)
    page.end += std::to_integer<int64_t>(head[static_cast<size_t>(Page::kHeader + i)]);
  return page;
}

/// The place where the next page may begin, or the end of the source.
int64_t NextCapture(const ByteSource& source, int64_t at) {
  std::string piece(1 << 16, '\0');
  for (; at < source.size; at += std::ssize(piece) - 3) {
    const size_t read = source.read_at(at, std::as_writable_bytes(std::span(piece)));
    const size_t found = std::string_view(piece).substr(0, read).find("OggS");
    if (found != std::string_view::npos) return at + static_cast<int64_t>(found);
  }
  return source.size;
}

/// One logical stream or several side by side; files may chain several links.
struct Link {
  int64_t begin = 0, end = 0;
  std::string codec;  // vorbis, opus, flac, or the codec's own name
  bool is_whole = false;
};

std::string CodecAt(const ByteSource& source, int64_t body) {
  if (source.Has(body, "\x01vorbis")) return "vorbis";
  if (source.Has(body, "OpusHead")) return "opus";
  if (source.Has(body,
                 "\x7f"
                 "FLAC"))
    return "flac";
  if (source.Has(body, "Speex")) return "Speex";
  return "";
}

std::vector<Link> LinksOf(const ByteSource& source) {
  std::vector<Link> links;
  bool in_head = false;
  for (int64_t at = 0; at < source.size;) {
    const std::optional<Page> page = PageAt(source, at);
    if (!page) {
      at = NextCapture(source, at + 1);
      continue;
    }
    if (page->is_first && !in_head) links.push_back({.begin = page->begin, .codec = {}});
    in_head = page->is_first;
    if (!links.empty()) {
      Link& link = links.back();
      const std::string codec = page->is_first ? CodecAt(source, page->body) : "";
      if (link.codec.empty() || link.codec == "Speex")
        link.codec = codec.empty() ? link.codec : codec;
      link.end = std::min(page->end, source.size);
      link.is_whole = page->is_last && page->end <= source.size;
    }
    at = page->end;
  }
  return links;
}

class VorbisReader final : public SoundReader {
 public:
  VorbisReader(ByteSource source, const std::string& name)
      : name_(name), stream_{std::move(source)} {
    const ov_callbacks callbacks{[](void* to, size_t size, size_t count, void* user) {
                                   return static_cast<Stream*>(user)->Read(to, size * count) / size;
                                 },
                                 nullptr, nullptr, nullptr};
    if (ov_open_callbacks(&stream_, &file_, nullptr, 0, callbacks) != 0)
      throw InvalidArgument(name_, "not Ogg Vorbis audio, or its headers are damaged");
    const vorbis_info* info = ov_info(&file_, -1);
    sample_rate_ = static_cast<int>(info->rate);
    channels_ = info->channels;
  }
  ~VorbisReader() override { ov_clear(&file_); }
  VorbisReader(const VorbisReader&) = delete;
  VorbisReader& operator=(const VorbisReader&) = delete;

  int64_t Read(std::span<float> interleaved) override {
    const int64_t wanted = std::ssize(interleaved) / channels_;
    int64_t count = 0;
    while (count < wanted) {
      float** pcm = nullptr;
      int section = 0;
      const long got = ov_read_float(
          &file_, &pcm, static_cast<int>(std::min<int64_t>(wanted - count, 4096)), &section);
      if (got == OV_HOLE) {
        if (++holes_ == 1) notes_.push_back("bytes of it are missing or damaged and are skipped");
        continue;
      }
      if (got <= 0) break;
      for (long i = 0; i < got; ++i, ++count) {
        for (int c = 0; c < channels_; ++c)
          interleaved[static_cast<size_t>(count * channels_ + c)] = pcm[c][i];
      }
    }
    return count;
  }

 private:
  const std::string name_;
  Stream stream_;
  OggVorbis_File file_{};
  int64_t holes_ = 0;
};

class OpusReader final : public SoundReader {
 public:
  OpusReader(ByteSource source, const std::string& name) : name_(name), stream_{std::move(source)} {
    const OpusFileCallbacks callbacks{
        [](void* user, unsigned char* to, int bytes) {
          return static_cast<int>(static_cast<Stream*>(user)->Read(to, static_cast<size_t>(bytes)));
        },
        nullptr, nullptr, nullptr};
    file_.reset(op_open_callbacks(&stream_, &callbacks, nullptr, 0, nullptr));
    if (!file_) throw InvalidArgument(name_, "not Ogg Opus audio, or its headers are damaged");
    sample_rate_ = 48000;  // Opus always decodes to 48 kHz
    channels_ = op_channel_count(file_.get(), -1);
  }

  int64_t Read(std::span<float> interleaved) override {
    const int64_t wanted = std::ssize(interleaved) / channels_;
    int64_t count = 0;
    while (count < wanted) {
      const auto rest = interleaved.subspan(static_cast<size_t>(count * channels_));
      const int got =
          op_read_float(file_.get(), rest.data(), static_cast<int>(rest.size()), nullptr);
      if (got == OP_HOLE) {
        if (++holes_ == 1) notes_.push_back("bytes of it are missing or damaged and are skipped");
        continue;
      }
      if (got <= 0) break;
      count += got;
    }
    return count;
  }

 private:
  struct Free {
    void operator()(OggOpusFile* file) const { op_free(file); }
  };
  const std::string name_;
  Stream stream_;
  std::unique_ptr<OggOpusFile, Free> file_;
  int64_t holes_ = 0;
};

/// A reader, and a note on a missing last page.
class LinkReader final : public SoundReader {
 public:
  LinkReader(std::unique_ptr<SoundReader> reader, bool is_whole) : reader_(std::move(reader)) {
    sample_rate_ = reader_->sample_rate();
    channels_ = reader_->channels();
    is_whole_ = is_whole;
  }
  int64_t Read(std::span<float> interleaved) override {
    const int64_t count = reader_->Read(interleaved);
    read_ += count;
    if (count == 0 && !ended_) {
      ended_ = true;
      notes_ = reader_->notes();
      if (!is_whole_)
        notes_.push_back("the last page of its Ogg stream is missing; it is read up to second " +
                         std::to_string(read_ / sample_rate_));
    }
    return count;
  }

 private:
  std::unique_ptr<SoundReader> reader_;
  bool is_whole_ = true, ended_ = false;
  int64_t read_ = 0;
};

}  // namespace

std::unique_ptr<SoundReader> ReadOgg(const ByteSource& source, const std::string& name) {
  const std::vector<Link> links = LinksOf(source);
  std::vector<ByteSource> parts;
  for (const Link& link : links) parts.push_back(PartOf(source, link.begin, link.end));
  if (parts.empty()) throw InvalidArgument(name, "not Ogg audio: it has no first page");
  size_t next = 0;
  return ReadOneAfterAnother(
      std::move(parts),
      [=](const ByteSource& part) mutable -> std::unique_ptr<SoundReader> {
        const Link& link = links[next++];
        std::unique_ptr<SoundReader> reader;
        if (link.codec == "vorbis") {
          reader = std::make_unique<VorbisReader>(part, name);
        } else if (link.codec == "opus") {
          reader = std::make_unique<OpusReader>(part, name);
        } else if (link.codec == "flac") {
          reader = ReadOggFlac(part, name);
        } else {
          throw Error(ErrorCode::kInvalidArgument, name,
                      (link.codec.empty() ? std::string("another codec") : link.codec) +
                          " in Ogg is not Vorbis, Opus or FLAC: " + kAskFfmpeg + " converts it",
                      Remedy::kConvert);
        }
        return std::make_unique<LinkReader>(std::move(reader), link.is_whole);
      },
      name);
}

}  // namespace choreo
