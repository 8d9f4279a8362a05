#include "model/audio/decode/sound_bytes.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/core/error.h"

namespace choreo {

bool ByteSource::Has(int64_t offset, const std::string& text) const {
  std::string found(text.size(), '\0');
  return read_at(offset, std::as_writable_bytes(std::span(found))) == text.size() && found == text;
}

uint32_t ByteSource::Word(int64_t offset) const {
  uint32_t word = 0;  // files are little-endian, as we are
  if (read_at(offset, std::as_writable_bytes(std::span(&word, 1))) < sizeof word) return 0;
  return word;
}

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

ByteSource FileBytes(const std::filesystem::path& path, int64_t most) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  const auto file = std::make_shared<std::ifstream>(path, std::ios::binary);
  if (!*file || std::filesystem::is_directory(status))
    throw Error(ErrorCode::kNotFound, path.string(), "cannot be opened as a file");
  if (!std::filesystem::is_regular_file(status)) {
    const auto bytes = std::make_shared<std::vector<std::byte>>();
    std::vector<std::byte> piece(1 << 16);
    while (*file) {
      file->read(reinterpret_cast<char*>(piece.data()), static_cast<std::streamsize>(piece.size()));
      bytes->insert(bytes->end(), piece.begin(), piece.begin() + file->gcount());
      if (std::ssize(*bytes) > most) {
        throw InvalidArgument(path.string(), "holds more than " + std::to_string(most) +
                                                 " bytes, the limit for a pipe");
      }
    }
    const ByteSource memory = MemoryBytes(*bytes);
    return {memory.size, [bytes, memory](int64_t offset, std::span<std::byte> to) {
              return memory.read_at(offset, to);
            }};
  }
  const auto size = static_cast<int64_t>(std::filesystem::file_size(path, error));
  if (error) throw Error(ErrorCode::kNotFound, path.string(), "cannot be opened as a file");
  return {size, [file](int64_t offset, std::span<std::byte> bytes) {
            file->clear();
            file->seekg(offset);
            file->read(reinterpret_cast<char*>(bytes.data()),
                       static_cast<std::streamsize>(bytes.size()));
            return static_cast<size_t>(std::max<std::streamsize>(file->gcount(), 0));
          }};
}

ByteSource PartOf(const ByteSource& source, int64_t begin, int64_t end) {
  const int64_t size = std::max<int64_t>(0, std::min(end, source.size) - begin);
  return {size, [source, begin, size](int64_t offset, std::span<std::byte> bytes) -> size_t {
            if (offset < 0 || offset >= size) return 0;
            const auto count = std::min<size_t>(bytes.size(), static_cast<size_t>(size - offset));
            return source.read_at(begin + offset, bytes.first(count));
          }};
}

ByteSource Patched(const ByteSource& source, int64_t at, std::string patch) {
  return {
      source.size,
      [source, at, patch = std::move(patch)](int64_t offset, std::span<std::byte> bytes) -> size_t {
        const size_t read = source.read_at(offset, bytes);
        const int64_t from = std::max(offset, at);
        const int64_t to = std::min(offset + static_cast<int64_t>(read), at + std::ssize(patch));
        if (from < to)
          std::memcpy(bytes.data() + (from - offset), patch.data() + (from - at),
                      static_cast<size_t>(to - from));
        return read;
      }};
}

}  // namespace choreo
