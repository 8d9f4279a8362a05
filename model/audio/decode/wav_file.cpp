#include <sndfile.h>

#include <algorithm>
#include <memory>

#include "model/audio/decode/decode.h"
#include "model/audio/decode/sound_reader.h"
#include "model/core/error.h"

namespace choreo {
namespace {

/// libsndfile's position in a ByteSource.
struct Cursor {
  ByteSource source;
  int64_t position = 0;
};

sf_count_t CursorSize(void* user) { return static_cast<Cursor*>(user)->source.size; }

sf_count_t CursorSeek(sf_count_t offset, int whence, void* user) {
  Cursor& cursor = *static_cast<Cursor*>(user);
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

class WavReader final : public SoundReader {
 public:
  WavReader(ByteSource source, const std::string& name, std::vector<std::string> notes)
      : name_(name), cursor_{std::move(source)} {
    notes_ = std::move(notes);
    SF_VIRTUAL_IO io{CursorSize, CursorSeek, CursorRead, nullptr, CursorTell};
    SF_INFO info{};
    file_.reset(sf_open_virtual(&io, SFM_READ, &info, &cursor_));
    if (!file_) {
      throw Error(ErrorCode::kInvalidArgument, name_,
                  std::string("not a known kind of WAV audio: ") + sf_strerror(nullptr) + " " +
                      kAskFfmpeg + " may convert it",
                  Remedy::kConvert);
    }
    sample_rate_ = info.samplerate;
    channels_ = info.channels;
  }
  WavReader(const WavReader&) = delete;  // libsndfile keeps a pointer to the cursor
  WavReader& operator=(const WavReader&) = delete;

  int64_t Read(std::span<float> interleaved) override {
    const auto wanted = std::ssize(interleaved) / channels_;
    const int64_t got = sf_readf_float(file_.get(), interleaved.data(), wanted);
    read_ += got;
    if (const int error = sf_error(file_.get()); error != SF_ERR_NO_ERROR)
      notes_.push_back("damaged after sample " + std::to_string(read_) + ": " +
                       sf_error_number(error));
    return got;
  }

 private:
  struct Close {
    void operator()(SNDFILE* file) const { sf_close(file); }
  };
  const std::string name_;
  Cursor cursor_;
  std::unique_ptr<SNDFILE, Close> file_;
  int64_t read_ = 0;
};

std::string FourBytes(uint32_t word) { return {reinterpret_cast<const char*>(&word), sizeof word}; }

/// Whether a chunk of a RIFF file may begin here: letters, and a length within the file.
bool IsChunk(const ByteSource& source, int64_t at) {
  if (at + 8 > source.size) return at >= source.size - 1;  // the end, or its padding byte
  for (const char letter : FourBytes(source.Word(at))) {
    if (letter < ' ' || letter > '~') return false;
  }
  return at + 8 + int64_t{source.Word(at + 4)} <= source.size + 1;
}

/// Whether the data is a compressed stream for a receiver (IEC 61937), such as AC-3.
bool IsBurst(const ByteSource& source, int64_t body) {
  constexpr int64_t kSearched = 16384;
  constexpr uint32_t kSync = 0x4e1ff872;
  for (int64_t at = body; at < std::min(body + kSearched, source.size - 4); at += 2)
    if (source.Word(at) == kSync) return true;
  return false;
}

/// The place of the chunk after one of `size` bytes: some files omit the padding byte, which is 0
/// and so begins no chunk.
int64_t After(const ByteSource& source, int64_t body, int64_t size) {
  return IsChunk(source, body + size) ? body + size : body + size + size % 2;
}

/// The unchanged chunk at `at` with its length; "" if it is too long for a format's.
std::string FormatAt(const ByteSource& source, int64_t at) {
  constexpr int64_t kMaxSize = 1024;
  const int64_t size = source.Word(at + 4);
  if (size > kMaxSize) return "";
  std::string chunk(static_cast<size_t>(std::min(8 + size, source.size - at)), '\0');
  source.read_at(at, std::as_writable_bytes(std::span(chunk)));
  return chunk;
}

/// The samples with a new header in place of the file's, because libsndfile searches differently
/// from other readers if chunks are odd or lengths wrong.
ByteSource Plain(const ByteSource& source, const std::string& format, int64_t body, int64_t size) {
  const std::string head = "WAVE" + format + "data" + FourBytes(static_cast<uint32_t>(size));
  const auto all = std::min<int64_t>(std::ssize(head) + size, UINT32_MAX);
  const int64_t begin = body - 8 - std::ssize(head);
  return Patched(PartOf(source, begin, body + size), 0,
                 "RIFF" + FourBytes(static_cast<uint32_t>(all)) + head);
}

/// The files in one that `cat a b` joined. Each chunk of samples becomes a file of its own if there
/// are several.
std::vector<ByteSource> PartsOf(const ByteSource& source, const std::string& name) {
  constexpr size_t kMaxCount = 1000;
  std::vector<ByteSource> parts;
  std::string format;
  int64_t begin = 0;
  bool has_samples = false;  // the file that began there
  for (int64_t at = 0; at + 8 <= source.size;) {
    const int64_t body = at + 8, size = source.Word(at + 4);
    if (source.Has(at, "RIFF") && source.Has(body, "WAVE")) {
      begin = at;
      has_samples = false;
      at = body + 4;
      continue;
    }
    if (source.Has(at, "fmt ")) format = FormatAt(source, at);
    const bool is_data = source.Has(at, "data"),
               is_whole = IsChunk(source, at) && (size > 0 || !is_data);
    const int64_t after = is_whole ? After(source, body, size) : source.size;
    if (is_data) {
      parts.push_back(has_samples ? Plain(source, format, body, is_whole ? size : after - body)
                                  : PartOf(source, begin, std::min(after, source.size)));
      has_samples = true;
    }
    if (parts.size() > kMaxCount)
      throw InvalidArgument(name,
                            "has more than " + std::to_string(kMaxCount) + " chunks of samples");
    at = after;
  }
  return parts;
}

}  // namespace

std::unique_ptr<SoundReader> ReadWav(const ByteSource& source, const std::string& name) {
  constexpr uint32_t kPcm = 1, kMpegLayer3 = 0x55;
  constexpr int64_t kMaxCount = 0xfffffff0;
  std::vector<std::string> notes;
  const auto as_it_is = [&] { return std::make_unique<WavReader>(source, name, notes); };
  if (source.Has(0, "RIFX")) return as_it_is();  // numbers the other way round
  // RF64 and BW64 have their lengths in a chunk of their own.
  const bool is_long = !source.Has(0, "RIFF");
  if (std::vector<ByteSource> parts = PartsOf(source, name); parts.size() > 1) {
    return ReadOneAfterAnother(
        std::move(parts), [name](const ByteSource& part) { return ReadWav(part, name); }, name);
  }
  int64_t long_size = 0;
  std::string format_chunk;
  uint32_t format = 0;
  bool odd = false;
  for (int64_t at = 12; at + 8 <= source.size;) {
    const int64_t body = at + 8;
    int64_t size = source.Word(at + 4);
    if (source.Has(at, "ds64"))
      long_size = int64_t{source.Word(body + 8)} | int64_t{source.Word(body + 12) & 0xffff} << 32;
    if (source.Has(at, "fmt ")) {
      format = source.Word(body) & 0xffff;
      format_chunk = FormatAt(source, at);
    }
    if (source.Has(at, "LIST") && source.Has(body, "wavl"))
      throw InvalidArgument(name, "stores its samples in pieces (a wavl list), which is not read");
    if (!source.Has(at, "data")) {
      odd = odd || size % 2 != 0;
      at = After(source, body, size);
      continue;
    }
    if (is_long && size == UINT32_MAX) size = long_size;
    // Programs that write into a pipe cannot know the length and state any number.
    const int64_t held = source.size - body;
    const bool is_right = size > 0 && size <= held && IsChunk(source, After(source, body, size));
    if (format == kMpegLayer3)
      return ReadMpeg(PartOf(source, body, is_right ? body + size : source.size), name);
    if (format == kPcm && IsBurst(source, body)) {
      throw Error(ErrorCode::kInvalidArgument, name,
                  std::string("contains data for a receiver, such as AC-3, not samples: ") +
                      kAskFfmpeg + " converts it",
                  Remedy::kConvert);
    }
    if (!is_right && held > 0) {
      notes.push_back("its header says " + std::to_string(size) + " bytes of samples, " +
                      std::to_string(held) + " are there");
      size = held;
    }
    const bool plain = (is_long || odd || !is_right) && held > 0 && !format_chunk.empty() &&
                       (!is_right || size <= kMaxCount);
    if (!plain) return as_it_is();
    return std::make_unique<WavReader>(Plain(source, format_chunk, body, std::min(size, kMaxCount)),
                                       name, notes);
  }
  throw InvalidArgument(
      name, "truncated: it ends at byte " + std::to_string(source.size) + ", before any samples");
}

}  // namespace choreo
