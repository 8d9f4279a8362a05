#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace choreo {

/// Parses the HTTP/2 frames that a client sends, and detects two floods that gRPC 1.51 lets
/// through:
/// - The received headers of a call, a HEADERS frame and its CONTINUATIONs (RFC 9113, 6.10), are
///   too long. gRPC refuses calls with more than 8 KiB of headers, but only once it has received
///   them all.
/// - Frames with little content come too fast. gRPC works on each of them, and no limit on calls
///   and no flow-control window bounds them. A DATA frame counts by the share of kFullFrame that
///   it lacks. A call counts as kFramesOfCall: a client that does not acknowledge the server's
///   settings has no limit on calls, and each call takes 18 KB until a thread has handled it.
/// A connection that does not begin with HTTP/2's preface (3.4) has no frames and floods nothing:
/// gRPC closes it.
class FrameMeter {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Flood { kNone, kHeaders, kEmptyFrames };

  /// Reads the next bytes, received at `now`. Do not call it again after a flood.
  Flood Read(std::span<const uint8_t> bytes, Clock::time_point now = Clock::now());
  bool flooded() const { return flooded_; }

  static constexpr size_t kMostHeaderBytes = 64 << 10;  ///< including frame headers
  /// The limit per second. 50 dances on one connection, each with a few window updates and pings a
  /// second, need some hundreds.
  static constexpr int kMostEmptyFrames = 10'000;
  static constexpr int kFramesOfCall = 2;
  /// The bytes from which a DATA frame counts as full. A key, or 2 ms of music, has more: a client
  /// may send a whole song at once.
  static constexpr size_t kFullFrame = 64;

 private:
  static constexpr std::string_view kPreface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
  static constexpr size_t kFrameHead = 9;

  /// Reads the preface's share of `bytes`, and returns the rest.
  std::span<const uint8_t> ReadPreface(std::span<const uint8_t> bytes);
  Flood ReadFrame(int type, size_t length);
  Flood AddHeaders(size_t bytes);
  Flood Lack(size_t bytes);

  size_t preface_ = 0;       // bytes of it
  bool is_foreign_ = false;  // something else came in its place
  size_t skipped_ = 0;       // bytes until the next frame's header
  bool in_headers_ = false;  // the skipped bytes are headers
  std::array<uint8_t, kFrameHead> head_{};
  size_t head_bytes_ = 0;
  size_t headers_ = 0;  // bytes received
  bool flooded_ = false;
  Clock::time_point second_ends_;
  size_t lacking_ = 0;  // bytes by which this second's frames fall short of full ones
};

}  // namespace choreo
