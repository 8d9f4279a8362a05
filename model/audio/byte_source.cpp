#include "model/audio/byte_source.h"

#include <algorithm>
#include <fstream>
#include <memory>

#include "model/core/error.h"

namespace choreo {

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

}  // namespace choreo
