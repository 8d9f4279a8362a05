#include <poll.h>
#include <sys/resource.h>

#include <atomic>
#include <fstream>
#include <iostream>
#include <thread>

#include "server/listener.h"
#include "tests/server/fixture.h"
#include "tests/server/silent_connections.h"

/// Clients that speak HTTP/2 to do harm, and those who are served meanwhile.
namespace choreo {
namespace {

using Clock = std::chrono::steady_clock;

/// A connection that says whatever it wants.
class Http2 {
 public:
  explicit Http2(int port) : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    Send("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + Frame(kSettings, 0, 0, ""));
  }
  ~Http2() { close(fd_); }
  Http2(const Http2&) = delete;
  Http2& operator=(const Http2&) = delete;

  static constexpr int kData = 0, kHeaders = 1, kReset = 3, kSettings = 4;

  static std::string Frame(int type, int flags, uint32_t stream, const std::string& payload) {
    std::string frame;
    for (int shift = 16; shift >= 0; shift -= 8)
      frame += static_cast<char>(payload.size() >> shift);
    frame += static_cast<char>(type);
    frame += static_cast<char>(flags);
    for (int shift = 24; shift >= 0; shift -= 8) frame += static_cast<char>(stream >> shift);
    return frame + payload;
  }
  /// The headers of a call, in HPACK's words that need no table and no Huffman code.
  static std::string Call(uint32_t stream, const std::string& method) {
    const auto text = [](const std::string& value) {
      return static_cast<char>(value.size()) + value;
    };
    const std::string block =
        std::string("\x83\x86\x04", 3) + text("/choreo.v1.Choreography/" + method) + '\x01' +
        text("x") + "\x0f\x10" + text("application/grpc") + '\0' + text("te") + text("trailers");
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
  /// Reads what has come, and drops it.
  void Drain() {
    char bytes[65536];
    while (recv(fd_, bytes, sizeof bytes, MSG_DONTWAIT) > 0) {
    }
  }
  /// Whether a call's end comes (its trailers, or a reset) within ten seconds, or the connection's.
  bool Ends(uint32_t stream) {
    std::string got;
    const auto until = Clock::now() + std::chrono::seconds(10);
    while (Clock::now() < until) {
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

int64_t ResidentBytes() {
  std::ifstream statm("/proc/self/statm");
  int64_t total = 0, resident = 0;
  statm >> total >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

class HostileTest : public ServerTest {
 protected:
  // Dances one after another while `harm` goes on; the longest took so many seconds.
  double SlowestDanceDuring(const std::function<void()>& harm) {
    std::atomic<bool> over = false;
    std::jthread harming([&] {
      harm();
      over = true;
    });
    double slowest = 0;
    do {
      const auto begin = Clock::now();
      DanceClient client(stub());
      client.Send(Config());
      client.SendKeyframe(Key("a", 20));
      EXPECT_TRUE(client.Finish().status.ok());
      slowest = std::max(slowest, std::chrono::duration<double>(Clock::now() - begin).count());
    } while (!over);
    return slowest;
  }
};

// A length of 4 GiB is announced, and a little comes: nothing is set aside for the rest, and the
// call ends as one whose first message does not come.
TEST_F(HostileTest, AMessageOf4GiBTakesNoMemory) {
  Start(16, [](ServerConfig& config) { config.first_message_seconds = 1; });
  const int64_t before = ResidentBytes();
  Http2 client(server->port());
  const std::string begun = std::string("\0\xff\xff\xff\xff", 5) + std::string(1000, 'x');
  uint32_t stream = 1;
  for (const char* method : {"GetServerInfo", "GenerateTransition", "StreamDance"}) {
    client.Send(Http2::Call(stream, method) + Http2::Frame(Http2::kData, 0, stream, begun));
    stream += 2;
  }
  EXPECT_TRUE(client.Ends(stream - 2));
  const int64_t grown = ResidentBytes() - before;
  EXPECT_LT(grown, 64 << 20);
  SlowestDanceDuring([] {});
  std::cout << "memory grew by " << (grown >> 10) << " KiB\n";
}

// Calls that are reset as soon as they are begun, as fast as they can be sent.
TEST_F(HostileTest, OthersAreServedBesideRapidResets) {
  // They come from the address of the others here, who would share its places.
  Start(16, [](ServerConfig& config) { config.max_streams_of_peer = 65'536; });
  constexpr int kCalls = 20'000, kAtOnce = 100;
  const int64_t before = ResidentBytes();
  const double slowest = SlowestDanceDuring([&] {
    Http2 client(server->port());
    uint32_t stream = 1;
    for (int i = 0; i < kCalls; i += kAtOnce) {
      std::string bytes;
      for (int k = 0; k < kAtOnce; ++k, stream += 2) {
        bytes += Http2::Call(stream, "StreamDance") +
                 Http2::Frame(Http2::kReset, 0, stream, std::string("\0\0\0\x08", 4));
      }
      if (!client.Send(bytes)) return;
      client.Drain();
    }
  });
  ExpectIdle();
  const int64_t grown = ResidentBytes() - before;
  EXPECT_LT(grown, 256 << 20);
  std::cout << kCalls << " calls reset: the slowest dance of the others took " << slowest
            << " s, memory grew by " << (grown >> 20) << " MiB\n";
}

TEST_F(HostileTest, ConnectionsThatSayNothingHoldUpNobody) {
  constexpr int kConnections = 2'000;
  RaiseDescriptorLimit();
  const cli::LocalServer server_of_its_own(FAKE_CHOREOD);
  const SilentConnections silent(server_of_its_own.address(), kConnections);
  const auto begin = Clock::now();
  ExpectEventually([&] { return Serves(server_of_its_own); }, "somebody new is served");
  std::cout << "beside " << kConnections - silent.Closed()
            << " silent connections somebody new is served in "
            << std::chrono::duration<double>(Clock::now() - begin).count() << " s\n";
}

}  // namespace
}  // namespace choreo
