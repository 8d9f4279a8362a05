#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <string>
#include <thread>

namespace choreo {

/// Forwards the bytes of one connection between a client and a server on this machine until
/// FallSilent. Then neither side receives anything more, not even the end of the connection.
class TcpProxy {
 public:
  /// `upward`: the number of bytes after which the proxy falls silent towards the server only.
  explicit TcpProxy(int server_port, int64_t upward = std::numeric_limits<int64_t>::max())
      : listening_(socket(AF_INET, SOCK_STREAM, 0)), upward_(upward) {
    sockaddr_in address = Local(0);
    bind(listening_, reinterpret_cast<sockaddr*>(&address), sizeof address);
    listen(listening_, 1);
    socklen_t size = sizeof address;
    getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size);
    address_ = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    thread_ =
        std::jthread([this, server_port](const std::stop_token& stop) { Work(server_port, stop); });
  }
  ~TcpProxy() {
    thread_.request_stop();
    thread_.join();
    close(listening_);
  }
  TcpProxy(const TcpProxy&) = delete;
  TcpProxy& operator=(const TcpProxy&) = delete;

  const std::string& address() const { return address_; }
  void FallSilent() { silent_ = true; }
  /// Whether all upward bytes have been forwarded.
  bool upward_done() const { return upward_ == 0; }

 private:
  static sockaddr_in Local(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }

  static bool Readable(int fd) {
    pollfd waited{.fd = fd, .events = POLLIN, .revents = 0};
    return poll(&waited, 1, 1) == 1;
  }

  void Work(int server_port, const std::stop_token& stop) {
    while (!Readable(listening_)) {
      if (stop.stop_requested()) return;
    }
    const int client = accept(listening_, nullptr, nullptr);
    const int server = socket(AF_INET, SOCK_STREAM, 0);
    const sockaddr_in address = Local(server_port);
    connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    int64_t never = std::numeric_limits<int64_t>::max();
    bool open = true;
    while (open && !stop.stop_requested()) {
      if (silent_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      open = Pass(client, server, upward_) && Pass(server, client, never);
    }
    close(client);
    close(server);
  }

  // Returns false once either side has closed.
  template <class Budget>
  static bool Pass(int from, int to, Budget& budget) {
    std::array<char, 65536> bytes;
    if (budget == 0 || !Readable(from)) return true;
    const auto most = std::min<int64_t>(bytes.size(), budget);
    const ssize_t count = recv(from, bytes.data(), static_cast<size_t>(most), 0);
    budget -= std::max<ssize_t>(count, 0);
    return count > 0 && send(to, bytes.data(), static_cast<size_t>(count), MSG_NOSIGNAL) == count;
  }

  int listening_;
  std::string address_;
  std::atomic<int64_t> upward_;
  std::atomic<bool> silent_ = false;
  std::jthread thread_;
};

}  // namespace choreo
