#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

namespace choreo {

/// Bytes to decode, wherever they lie. Not thread-safe.
struct ByteSource {
  int64_t size = 0;
  /// Copies the bytes from `offset` on and returns how many there were: fewer than asked at the
  /// end, 0 beyond it.
  std::function<size_t(int64_t offset, std::span<std::byte> bytes)> read_at;
};

/// Throws Error(kNotFound), with the path as field, where the file cannot be opened.
ByteSource FileBytes(const std::filesystem::path& path);
/// `bytes` must outlive the source.
ByteSource MemoryBytes(std::span<const std::byte> bytes);

}  // namespace choreo
