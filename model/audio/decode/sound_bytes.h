#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace choreo {

/// A source of bytes to decode. Not thread-safe.
struct ByteSource {
  int64_t size = 0;
  /// Copies bytes from `offset` on and returns their number: fewer than requested near the end, 0
  /// beyond it.
  std::function<size_t(int64_t offset, std::span<std::byte> bytes)> read_at;

  /// Whether `text` is at `offset`.
  bool Has(int64_t offset, const std::string& text) const;
  /// The little-endian word at `offset`; 0 beyond the end.
  uint32_t Word(int64_t offset) const;
};

/// `memory` must outlive the source.
ByteSource MemoryBytes(std::span<const std::byte> memory);

/// A file. Pipes and devices, which cannot seek, are read to their end, at most `most` bytes.
/// Throws Error(kNotFound), with the path as field, if it cannot be opened, and
/// Error(kInvalidArgument) if it holds more.
ByteSource FileBytes(const std::filesystem::path& path, int64_t most);

/// The bytes [begin, end) of another source.
ByteSource PartOf(const ByteSource& source, int64_t begin, int64_t end);

/// The same bytes, overwritten from `offset` on.
ByteSource Patched(const ByteSource& source, int64_t offset, std::string bytes);

}  // namespace choreo
