#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

namespace choreo {

/// Follows the frames that a client sends over HTTP/2, and tells of two floods that gRPC 1.51 lets
/// through:
/// - the headers of a call, a HEADERS frame and its CONTINUATIONs (RFC 9113, 6.10), grow too long.
///   gRPC refuses calls with more than 8 KiB of headers, but not before it has them all.
/// - frames that carry nothing come too fast: all but headers and data that is not empty. gRPC
///   works on each of them, and no call or window bounds them.
class FrameMeter {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Flood { kNone, kHeaders, kEmptyFrames };

  /// Takes the next bytes, which came `now`. Take no more after a flood.
  Flood Take(std::span<const uint8_t> bytes, Clock::time_point now = Clock::now());

  static constexpr size_t kMostHeaderBytes = 64 << 10;  ///< with the heads of their frames
  /// In one second. A server's 50 dances for a core, each with a few windows and pings a second,
  /// need some hundreds.
  static constexpr int kMostEmptyFrames = 10'000;

 private:
  static constexpr size_t kPreface = 24, kFrameHead = 9;

  Flood TakeFrame(int type, size_t length);

  size_t skipped_ = kPreface;  // bytes until the next frame's head
  std::array<uint8_t, kFrameHead> head_{};
  size_t head_bytes_ = 0;
  size_t headers_ = 0;
  Clock::time_point second_ends_;
  int empty_frames_ = 0;  // in this second
};

}  // namespace choreo
