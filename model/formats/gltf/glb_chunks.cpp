#include "model/formats/gltf/glb_chunks.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/files/json_limits.h"
#include "model/core/text/printable.h"

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

Error NoGlb(const std::string& why) { return InvalidArgument("", "is not a binary glTF: " + why); }

// Removes and returns the first chunk of `bytes` if it has this type.
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

// "my%20walk.bin"
std::string Unescaped(const std::string& uri) {
  std::string name;
  for (size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    const char* digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      name += static_cast<char>(code);
      i += 2;
    } else {
      name += uri[i];
    }
  }
  return name;
}

// The bytes of a file that another file refers to.
std::string ReadBeside(const std::filesystem::path& path, const std::string& uri) {
  const std::filesystem::path name = Unescaped(uri);
  const auto up = std::ranges::find(name, "..");
  const std::filesystem::path beside = path.parent_path() / name;
  std::error_code error;
  if (name.is_absolute() || up != name.end() || !std::filesystem::is_regular_file(beside, error)) {
    throw InvalidArgument(
        "buffers[0].uri",
        '"' + Printable(uri) + "\" is not a file beside it: export it as .glb, which is one file");
  }
  return ReadFile(beside);
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

std::string ReadGltfBytes(const std::filesystem::path& path) {
  std::string bytes = ReadGlbBytes(path);
  const size_t first = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first == std::string::npos || bytes[first] != '{') return bytes;
  CheckJsonDepth(bytes, "");
  auto document = nlohmann::ordered_json::parse(bytes, nullptr, false);
  std::string beside;
  if (document.is_object() && document.contains("buffers") && document["buffers"].is_array()) {
    auto& buffers = document["buffers"];
    for (size_t i = 0; i < buffers.size(); ++i) {
      if (!buffers[i].is_object() || !buffers[i].contains("uri") || !buffers[i]["uri"].is_string())
        continue;
      const std::string uri = buffers[i]["uri"].get<std::string>();
      if (uri.starts_with("data:")) continue;
      if (i > 0) throw InvalidArgument("buffers", "lie in several files: export them as one .glb");
      beside = ReadBeside(path, uri);
      buffers[i].erase("uri");
    }
  }
  const std::string json = document.is_object() ? document.dump() : bytes;
  return JoinGlb({.json = json, .binary = beside, .others = {}});
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
