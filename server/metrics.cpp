#include "server/metrics.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "server/connections/listener.h"
#include "server/figures.h"

namespace choreo {
namespace {

/// The most connections. Each has a thread, so that idle ones delay nobody. (The library's own HTTP
/// server cannot run beside LibTorch, which needs larger thread stacks.)
constexpr size_t kMostConnections = 16;
constexpr int kPatienceMs = 5'000;
constexpr size_t kMaxRequestBytes = 8 << 10;

/// Limits the total time of one connection.
class Deadline {
 public:
  int left_ms() const {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        until_ - std::chrono::steady_clock::now());
    return std::max(0, static_cast<int>(left.count()));
  }

 private:
  const std::chrono::steady_clock::time_point until_ =
      std::chrono::steady_clock::now() + std::chrono::milliseconds(kPatienceMs);
};

/// The HTTP request; empty if it does not arrive in time or is too long.
std::string ReadRequest(int connection) {
  const Deadline deadline;
  std::string request;
  while (request.find("\r\n\r\n") == std::string::npos) {
    pollfd waited{.fd = connection, .events = POLLIN, .revents = 0};
    char bytes[1024];
    if (request.size() > kMaxRequestBytes || poll(&waited, 1, deadline.left_ms()) != 1) return "";
    const ssize_t count = recv(connection, bytes, sizeof bytes, 0);
    if (count <= 0) return "";
    request.append(bytes, static_cast<size_t>(count));
  }
  return request;
}

struct RequestLine {
  std::string_view method, path;  ///< without what follows a '?'
};

RequestLine ParseRequestLine(std::string_view request) {
  const std::string_view line = request.substr(0, request.find("\r\n"));
  const size_t space = std::min(line.find(' '), line.size());
  const std::string_view rest = line.substr(std::min(space + 1, line.size()));
  return {line.substr(0, space), rest.substr(0, rest.find_first_of("? "))};
}

void SendAll(int connection, std::string_view bytes) {
  const Deadline deadline;
  while (!bytes.empty()) {
    pollfd waited{.fd = connection, .events = POLLOUT, .revents = 0};
    if (poll(&waited, 1, deadline.left_ms()) != 1) return;
    const ssize_t count = send(connection, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count <= 0) return;
    bytes.remove_prefix(static_cast<size_t>(count));
  }
}

}  // namespace

struct MetricsEndpoint::Impl {
  Impl(const std::string& address, const Serving& serving_of_all)
      : serving(serving_of_all), listener(address, "--metrics") {
    listener.Start([this](int /*listening*/, int connection) { Serve(connection); });
  }
  ~Impl() {
    listener.Stop();
    std::unique_lock lock(mutex);
    LeaveAtMost(0, lock);
  }

  void Serve(int connection) {
    std::unique_lock lock(mutex);
    LeaveAtMost(kMostConnections - 1, lock);
    try {
      std::thread([this, connection] {
        Answer(connection);
        const std::lock_guard own(mutex);
        std::erase(open, connection);
        close(connection);
        closed.notify_all();
      }).detach();
      open.push_back(connection);
    } catch (const std::system_error&) {  // there are too many threads
      close(connection);
    }
  }

  /// Ends the oldest connections.
  void LeaveAtMost(size_t count, std::unique_lock<std::mutex>& lock) {
    for (size_t i = 0; i + count < open.size(); ++i) shutdown(open[i], SHUT_RDWR);
    closed.wait(lock, [&] { return open.size() <= count; });
  }

  void Answer(int connection) const {
    const std::string request = ReadRequest(connection);
    if (request.empty()) return;
    const RequestLine line = ParseRequestLine(request);
    const bool asks = line.method == "GET" || line.method == "HEAD";
    const bool known = line.path == "/metrics";
    const char* status = !asks   ? "405 Method Not Allowed\r\nAllow: GET, HEAD"
                         : known ? "200 OK"
                                 : "404 Not Found";
    const std::string body = asks && known ? FiguresOf(serving) : "GET /metrics\n";
    SendAll(connection, std::string("HTTP/1.1 ") + status +
                            "\r\nContent-Type: text/plain; version=0.0.4\r\nContent-Length: " +
                            std::to_string(body.size()) + "\r\nConnection: close\r\n\r\n" +
                            (line.method == "HEAD" ? "" : body));
  }

  const Serving& serving;
  std::mutex mutex;
  std::condition_variable closed;
  std::vector<int> open;  // oldest first; lock: mutex
  Listener listener;      // last, because its thread uses the members above
};

MetricsEndpoint::MetricsEndpoint(const std::string& address, const Serving& serving)
    : impl_(std::make_unique<Impl>(address, serving)) {}

MetricsEndpoint::~MetricsEndpoint() = default;

int MetricsEndpoint::port() const { return impl_->listener.port(); }

}  // namespace choreo
