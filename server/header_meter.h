#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace choreo {

/// Follows the frames that a client sends over HTTP/2, and tells of headers that grow too long: a
/// HEADERS frame and its CONTINUATIONs (RFC 9113, 6.10). gRPC refuses calls with more than 8 KiB of
/// headers, but not before it has them all.
class HeaderMeter {
 public:
  /// Takes the next bytes; false once the headers of a call are longer than kMostBytes.
  bool Take(std::span<const uint8_t> bytes);

  static constexpr size_t kMostBytes = 64 << 10;  ///< with the heads of their frames

 private:
  static constexpr size_t kPreface = 24, kFrameHead = 9;

  size_t skipped_ = kPreface;  // bytes until the next frame's head
  std::array<uint8_t, kFrameHead> head_{};
  size_t head_bytes_ = 0;
  size_t headers_ = 0;
};

}  // namespace choreo
