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
/// - frames that carry little come too fast: gRPC works on each of them, and no call or window
/// bounds
///   them. Data that lacks half of kFullFrame counts as half a frame. A call counts as
///   kFramesOfCall: who does not confirm the server's settings is bound by no limit of calls, and
///   each takes 18 KB until a thread has looked at it.
class FrameMeter {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Flood { kNone, kHeaders, kEmptyFrames };

  /// Takes the next bytes, which came `now`. Take no more after a flood.
  Flood Take(std::span<const uint8_t> bytes, Clock::time_point now = Clock::now());
  bool flooded() const { return flooded_; }

  static constexpr size_t kMostHeaderBytes = 64 << 10;  ///< with the heads of their frames
  /// In one second. A server's 50 dances for a core, each with a few windows and pings a second,
  /// need some hundreds.
  static constexpr int kMostEmptyFrames = 10'000;
  static constexpr int kFramesOfCall = 2;
  /// Bytes of data from which a frame has content. Less than a key or 2 ms of music has, since who
  /// sends a song may send all of it at once.
  static constexpr size_t kFullFrame = 64;

 private:
  static constexpr size_t kPreface = 24, kFrameHead = 9;

  Flood TakeFrame(int type, size_t length);
  Flood Lack(size_t bytes);

  size_t skipped_ = kPreface;  // bytes until the next frame's head
  std::array<uint8_t, kFrameHead> head_{};
  size_t head_bytes_ = 0;
  size_t headers_ = 0;
  bool flooded_ = false;
  Clock::time_point second_ends_;
  size_t lacking_ = 0;  // bytes of content, in this second
};

}  // namespace choreo
