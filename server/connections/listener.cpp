#include "server/connections/listener.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>

#include "model/core/error.h"
#include "network/address.h"

namespace choreo {
namespace {

/// Descriptors reserved for files, models, and gRPC itself.
constexpr rlim_t kReserved = 64;
constexpr int kAtATime = 256;  // connections accepted between checks for a stop
constexpr std::chrono::seconds kBetweenReports{1};
constexpr int kPauseMs = 100;  // before retrying accept without free descriptors

/// `wrong`: it can never be listened on here, so no restart mends it.
Error CannotListen(const std::string& field, const std::string& address, const char* why,
                   bool wrong) {
  return {wrong ? ErrorCode::kInvalidArgument : ErrorCode::kUnavailable, field,
          '"' + address + "\" cannot be listened on: " + why};
}

Error Unresolved(const std::string& field, const std::string& address, int why) {
  // A name server may answer later.
  return CannotListen(field, address, gai_strerror(why), why != EAI_AGAIN && why != EAI_SYSTEM);
}

Error Unbound(const std::string& field, const std::string& address, int why) {
  return CannotListen(field, address, std::strerror(why), why == EADDRNOTAVAIL);
}

struct Addresses {
  std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> first{nullptr, freeaddrinfo};
  int error = 0;  // of getaddrinfo, without a result
};

Addresses Resolve(const std::string& address) {
  const auto [host, port] = SplitAddress(address);
  addrinfo hints{};
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  Addresses addresses;
  addresses.error = getaddrinfo(WithoutBrackets(host).c_str(), port.c_str(), &hints, &found);
  addresses.first.reset(found);
  return addresses;
}

bool IsLoopback(const sockaddr& address) {
  if (address.sa_family == AF_INET6) {
    return IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6&>(address).sin6_addr);
  }
  const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
  return address.sa_family == AF_INET && ntohl(v4.sin_addr.s_addr) >> 24 == 127;
}

/// Connections get descriptors below this. The system assigns the lowest free one, so a
/// descriptor's number bounds their count.
int DescriptorsForConnections() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  const rlim_t most = std::min<rlim_t>(limit.rlim_cur, 1 << 20);
  return static_cast<int>(most - std::min(kReserved, most / 2));
}

int PortOf(int socket) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.ss_family == AF_INET6
                   ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                   : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

void SetPort(const addrinfo& at, int port) {
  if (at.ai_addr->sa_family == AF_INET6) {
    reinterpret_cast<sockaddr_in6*>(at.ai_addr)->sin6_port = htons(static_cast<uint16_t>(port));
  } else {
    reinterpret_cast<sockaddr_in*>(at.ai_addr)->sin_port = htons(static_cast<uint16_t>(port));
  }
}

/// Returns -1 and sets errno on failure.
int Bind(const addrinfo& at) {
  const int fd = socket(at.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return -1;
  const int on = 1, off = 0;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (at.ai_family == AF_INET6) setsockopt(fd, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
  if (bind(fd, at.ai_addr, at.ai_addrlen) == 0) return fd;
  const int why = errno;
  close(fd);
  errno = why;
  return -1;
}

/// Returns -1 and sets errno on failure.
int Listen(const addrinfo& at) {
  const int fd = Bind(at);
  if (fd < 0 || listen(fd, SOMAXCONN) == 0) return fd;
  const int why = errno;
  close(fd);
  errno = why;
  return -1;
}

}  // namespace

Listener::Listener(const std::string& address, const std::string& field) {
  const Addresses found = Resolve(address);
  if (!found.first) throw Unresolved(field, address, found.error);
  int why = 0;
  for (const addrinfo* at = found.first.get(); at != nullptr; at = at->ai_next) {
    // All addresses of a host share one port, even if the system chose it for the first.
    if (port_ != 0) SetPort(*at, port_);
    const int fd = Listen(*at);
    if (fd < 0) {
      why = errno;
      continue;
    }
    sockets_.push_back(fd);
    port_ = PortOf(fd);
  }
  if (sockets_.empty()) throw Unbound(field, address, why);
  stop_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
}

Listener::~Listener() {
  Stop();
  for (const int fd : sockets_) close(fd);
  close(stop_);
}

void Listener::Start(Accept accept) {
  thread_ = std::thread([this, accept = std::move(accept)] { Work(accept); });
}

void Listener::Stop() {
  if (!thread_.joinable()) return;
  const uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(stop_, &one, sizeof one);
  thread_.join();
  for (const int fd : sockets_) shutdown(fd, SHUT_RDWR);
}

void Listener::Work(const Accept& accept) {
  std::vector<pollfd> waited;
  for (const int fd : sockets_) waited.push_back({.fd = fd, .events = POLLIN, .revents = 0});
  waited.push_back({.fd = stop_, .events = POLLIN, .revents = 0});
  for (;;) {
    poll(waited.data(), waited.size(), -1);
    if (waited.back().revents != 0) return;
    for (size_t i = 0; i + 1 < waited.size(); ++i) {
      if (waited[i].revents != 0) AcceptAll(waited[i].fd, accept);
    }
  }
}

void Listener::AcceptAll(int listening, const Accept& accept) {
  for (int i = 0; i < kAtATime; ++i) {
    const int fd = accept4(listening, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd < 0) {
      if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) Pause();
      break;  // poll reports the next connection
    }
    if (fd >= DescriptorsForConnections()) {
      close(fd);
      ++refused_;
      continue;
    }
    const int on = 1;
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    accept(listening, fd);
  }
  const auto now = std::chrono::steady_clock::now();
  if (refused_ == 0 || now < next_report_) return;
  spdlog::warn("{} connections refused or made to wait: too few descriptors are left", refused_);
  refused_ = 0;
  next_report_ = now + kBetweenReports;
}

void Listener::Pause() {
  ++refused_;
  pollfd stop{.fd = stop_, .events = POLLIN, .revents = 0};
  poll(&stop, 1, kPauseMs);
}

void RequireOwnAddress(const std::string& address, const std::string& field) {
  const Addresses found = Resolve(address);
  if (!found.first) throw Unresolved(field, address, found.error);
  int why = 0;
  for (const addrinfo* at = found.first.get(); at != nullptr; at = at->ai_next) {
    SetPort(*at, 0);
    const int fd = Bind(*at);
    if (fd >= 0) {
      close(fd);
      return;
    }
    why = errno;
  }
  throw Unbound(field, address, why);
}

bool IsLocal(const std::string& address) {
  const Addresses found = Resolve(address);
  for (const addrinfo* at = found.first.get(); at != nullptr; at = at->ai_next) {
    if (!IsLoopback(*at->ai_addr)) return false;
  }
  return true;
}

void RaiseDescriptorLimit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == limit.rlim_max) return;
  limit.rlim_cur = limit.rlim_max;
  if (setrlimit(RLIMIT_NOFILE, &limit) != 0) {
    spdlog::warn("the limit of open files stays: {}", std::strerror(errno));
  }
}

}  // namespace choreo
