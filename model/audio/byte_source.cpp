#include "model/audio/byte_source.h"

#include <algorithm>
#include <fstream>

#include "model/core/error.h"

namespace choreo {
namespace {

class FileSource : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path) : file_(path, std::ios::binary) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (!file_ || error) {
      throw Error(ErrorCode::kNotFound, path.string(), "cannot be opened as a file");
    }
    size_ = static_cast<int64_t>(size);
  }

  int64_t size() const override { return size_; }

  size_t ReadAt(int64_t offset, std::span<std::byte> bytes) override {
    file_.clear();
    file_.seekg(offset);
    file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return static_cast<size_t>(std::max<std::streamsize>(file_.gcount(), 0));
  }

 private:
  std::ifstream file_;
  int64_t size_ = 0;
};

class MemorySource : public ByteSource {
 public:
  explicit MemorySource(std::span<const std::byte> bytes) : bytes_(bytes) {}

  int64_t size() const override { return static_cast<int64_t>(bytes_.size()); }

  size_t ReadAt(int64_t offset, std::span<std::byte> bytes) override {
    if (offset < 0 || offset >= size()) return 0;
    const auto rest = bytes_.subspan(static_cast<size_t>(offset));
    const size_t count = std::min(rest.size(), bytes.size());
    std::copy_n(rest.begin(), count, bytes.begin());
    return count;
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace

std::unique_ptr<ByteSource> FileBytes(const std::filesystem::path& path) {
  return std::make_unique<FileSource>(path);
}

std::unique_ptr<ByteSource> MemoryBytes(std::span<const std::byte> bytes) {
  return std::make_unique<MemorySource>(bytes);
}

}  // namespace choreo
