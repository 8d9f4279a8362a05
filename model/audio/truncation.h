#pragma once

#include <cstddef>
#include <cstdint>
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
};

/// Throws Error(kInvalidArgument), with `name` as field, for a WAV file whose samples end before
/// its header says so, and for an Ogg file that does not end with a whole page marked as the last.
/// libsndfile plays both without a word. Passes whatever else the bytes are.
void CheckNotTruncated(const ByteSource& source, const std::string& name);

}  // namespace choreo
