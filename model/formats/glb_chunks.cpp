#include "model/formats/glb_chunks.h"

#include <cstdint>
#include <cstring>

#include "model/core/atomic_file.h"
#include "model/core/error.h"

namespace choreo {
namespace {

constexpr uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBinary = 0x004E4942;
constexpr uint32_t kVersion = 2;
constexpr size_t kHeader = 12, kChunkHeader = 8;

uint32_t Word(std::string_view bytes, size_t at) {
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

void AppendWord(uint32_t word, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&word), sizeof(word));
}

Error NoGlb(const std::string& why) { return InvalidArgument("", "is no binary glTF: " + why); }

// The chunk that `bytes` begins with, if it is of this type; takes it off.
std::string_view TakeChunk(std::string_view& bytes, uint32_t type) {
  if (bytes.size() < kChunkHeader || Word(bytes, 4) != type) return {};
  const uint32_t length = Word(bytes, 0);
  if (length > bytes.size() - kChunkHeader) {
    throw NoGlb("a chunk of " + std::to_string(length) + " bytes where " +
                std::to_string(bytes.size() - kChunkHeader) + " are left");
  }
  const std::string_view chunk = bytes.substr(kChunkHeader, length);
  bytes.remove_prefix(kChunkHeader + length);
  return chunk;
}

void AppendChunk(std::string_view chunk, uint32_t type, char padding, std::string& bytes) {
  const size_t length = (chunk.size() + 3) / 4 * 4;
  AppendWord(static_cast<uint32_t>(length), bytes);
  AppendWord(type, bytes);
  bytes.append(chunk).append(length - chunk.size(), padding);
}

}  // namespace

std::string ReadGlbBytes(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw Error(ErrorCode::kNotFound, path.string(), "cannot be opened");
  if (!std::filesystem::is_regular_file(path, error)) throw NoGlb("no plain file");
  const uint64_t size = std::filesystem::file_size(path, error);
  if (error || size > UINT32_MAX) throw NoGlb("4 GiB or more");
  return ReadFile(path);
}

GlbChunks SplitGlb(std::string_view bytes) {
  if (bytes.size() < kHeader || Word(bytes, 0) != kMagic) throw NoGlb("bad header");
  if (Word(bytes, 4) != kVersion)
    throw NoGlb("version " + std::to_string(Word(bytes, 4)) + ", must be 2");
  if (Word(bytes, 8) > bytes.size()) {
    throw NoGlb("of " + std::to_string(Word(bytes, 8)) + " bytes " + std::to_string(bytes.size()) +
                " are there");
  }
  std::string_view left =
      bytes.substr(0, Word(bytes, 8)).substr(std::min<size_t>(kHeader, Word(bytes, 8)));
  GlbChunks chunks;
  chunks.json = TakeChunk(left, kJson);
  if (chunks.json.empty()) throw NoGlb("it does not begin with JSON");
  chunks.binary = TakeChunk(left, kBinary);
  chunks.others = left;
  return chunks;
}

std::string JoinGlb(const GlbChunks& chunks) {
  const uint64_t size = kHeader + 2 * (kChunkHeader + 3) + chunks.json.size() +
                        chunks.binary.size() + chunks.others.size();
  if (size > UINT32_MAX) throw InvalidArgument("", "becomes 4 GiB or more, which no glb can hold");
  std::string bytes;
  bytes.reserve(size);
  AppendWord(kMagic, bytes);
  AppendWord(kVersion, bytes);
  AppendWord(0, bytes);
  AppendChunk(chunks.json, kJson, ' ', bytes);
  if (!chunks.binary.empty()) AppendChunk(chunks.binary, kBinary, '\0', bytes);
  bytes += chunks.others;
  const auto total = static_cast<uint32_t>(bytes.size());
  std::memcpy(bytes.data() + 8, &total, sizeof(total));
  return bytes;
}

}  // namespace choreo
