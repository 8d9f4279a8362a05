#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace choreo {

/// Bytes to decode, wherever they lie. Not thread-safe.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  virtual int64_t size() const = 0;
  /// Copies the bytes from `offset` on and returns how many there were: fewer than asked at the
  /// end, 0 beyond it.
  virtual size_t ReadAt(int64_t offset, std::span<std::byte> bytes) = 0;
};

/// Throws Error(kNotFound), with the path as field, where the file cannot be opened.
std::unique_ptr<ByteSource> FileBytes(const std::filesystem::path& path);
/// `bytes` must outlive the source.
std::unique_ptr<ByteSource> MemoryBytes(std::span<const std::byte> bytes);

}  // namespace choreo
