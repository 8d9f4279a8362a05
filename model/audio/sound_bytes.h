#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace choreo {

/// Bytes to decode, wherever they lie. Not thread-safe.
struct ByteSource {
  int64_t size = 0;
  /// Copies the bytes from `offset` on and returns how many there were: fewer than asked at the
  /// end, 0 beyond it.
  std::function<size_t(int64_t offset, std::span<std::byte> bytes)> read_at;

  /// Whether `text` stands at `offset`.
  bool Has(int64_t offset, const std::string& text) const;
  /// Little-endian; 0 beyond the end.
  uint32_t Word(int64_t offset) const;
};

/// `memory` must outlive the source.
ByteSource MemoryBytes(std::span<const std::byte> memory);

/// A file. What cannot be sought in (a pipe, a device) is read to its end, `most` bytes of it.
/// Throws Error(kNotFound), with the path as field, where it cannot be opened,
/// Error(kInvalidArgument) where it has more.
ByteSource FileBytes(const std::filesystem::path& path, int64_t most);

/// The bytes [begin, end) of another source.
ByteSource PartOf(const ByteSource& source, int64_t begin, int64_t end);

/// The same bytes, but for those from `offset` on.
ByteSource Patched(const ByteSource& source, int64_t offset, std::string bytes);

}  // namespace choreo
