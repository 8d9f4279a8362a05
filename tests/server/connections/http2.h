#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <string>

namespace choreo {

/// A connection that sends arbitrary bytes.
class Http2 {
 public:
  /// `from`: its own address, one of this machine's.
  explicit Http2(int port, const char* from = "127.0.0.1") : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    inet_pton(AF_INET, from, &address.sin_addr);
    EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    Send("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + Frame(kSettings, 0, 0, ""));
  }
  ~Http2() { close(fd_); }
  Http2(const Http2&) = delete;
  Http2& operator=(const Http2&) = delete;

  static constexpr int kData = 0, kHeaders = 1, kReset = 3, kSettings = 4, kContinuation = 9;

  static std::string Frame(int type, int flags, uint32_t stream, const std::string& payload) {
    std::string frame;
    for (int shift = 16; shift >= 0; shift -= 8)
      frame += static_cast<char>(payload.size() >> shift);
    frame += static_cast<char>(type);
    frame += static_cast<char>(flags);
    for (int shift = 24; shift >= 0; shift -= 8) frame += static_cast<char>(stream >> shift);
    return frame + payload;
  }
  /// The headers of a call, in HPACK's words that need no table and no Huffman code. `method` is
  /// ours, or the path of somebody else's.
  static std::string Call(uint32_t stream, const std::string& method) {
    const std::string path = method.starts_with('/') ? method : "/choreo.v1.Choreography/" + method;
    const auto text = [](const std::string& value) {
      return static_cast<char>(value.size()) + value;
    };
    const std::string block = std::string("\x83\x86\x04", 3) + text(path) + '\x01' + text("x") +
                              "\x0f\x10" + text("application/grpc") + '\0' + text("te") +
                              text("trailers");
    constexpr int kEndHeaders = 4;
    return Frame(kHeaders, kEndHeaders, stream, block);
  }

  /// False once the server has closed the connection.
  bool Send(const std::string& bytes) {
    for (size_t sent = 0; sent < bytes.size();) {
      const ssize_t count = send(fd_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) return false;
      sent += static_cast<size_t>(count);
    }
    return true;
  }
  /// Begins so many calls and resets each at once, as fast as they can be sent; how many were sent
  /// before the server closed the connection.
  int Reset(int calls, const std::string& method = "StreamDance") {
    constexpr int kAtOnce = 100;
    uint32_t stream = 1;
    int begun = 0;
    for (; begun < calls; begun += kAtOnce) {
      std::string bytes;
      for (int k = 0; k < kAtOnce; ++k, stream += 2) {
        bytes += Call(stream, method) + Frame(kReset, 0, stream, std::string("\0\0\0\x08", 4));
      }
      if (!Send(bytes)) break;
      Drain();
    }
    return begun;
  }
  /// Reads the received bytes and drops them.
  void Drain() {
    char bytes[65536];
    while (recv(fd_, bytes, sizeof bytes, MSG_DONTWAIT) > 0) {
    }
  }
  /// Whether a call's end comes (its trailers, or a reset) within ten seconds, or the connection's.
  bool Ends(uint32_t stream) {
    std::string got;
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (std::chrono::steady_clock::now() < until) {
      pollfd waited{.fd = fd_, .events = POLLIN, .revents = 0};
      if (poll(&waited, 1, 100) != 1) continue;
      char bytes[65536];
      const ssize_t count = recv(fd_, bytes, sizeof bytes, 0);
      if (count <= 0) return true;
      got.append(bytes, static_cast<size_t>(count));
      while (got.size() >= 9) {
        const auto at = [&](size_t i) { return static_cast<unsigned char>(got[i]); };
        const size_t length = size_t{at(0)} << 16 | size_t{at(1)} << 8 | at(2);
        if (got.size() < 9 + length) break;
        const uint32_t of =
            uint32_t{at(5)} << 24 | uint32_t{at(6)} << 16 | uint32_t{at(7)} << 8 | at(8);
        const bool ends_stream = (at(4) & 1) != 0 && at(3) == kHeaders;
        if (of == stream && (ends_stream || at(3) == kReset)) return true;
        got.erase(0, 9 + length);
      }
    }
    return false;
  }

 private:
  const int fd_;
};

}  // namespace choreo
