#include "server/process/service_manager.h"

#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace choreo {
namespace {

// Returns 0 or errno.
int Send(const std::string& to, const std::string& state) {
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  if (to.size() >= sizeof address.sun_path) return ENAMETOOLONG;
  std::ranges::copy(to, address.sun_path);
  if (to.front() == '@') address.sun_path[0] = '\0';  // an abstract socket address
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return errno;
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + to.size());
  const bool sent = sendto(fd, state.data(), state.size(), MSG_NOSIGNAL,
                           reinterpret_cast<const sockaddr*>(&address), size) >= 0;
  const int why = sent ? 0 : errno;
  close(fd);
  return why;
}

}  // namespace

void TellManager(const std::string& state) {
  const char* to = std::getenv("NOTIFY_SOCKET");
  if (to == nullptr || *to == '\0') return;
  if (const int why = Send(to, state); why != 0)
    spdlog::warn("$NOTIFY_SOCKET: {} cannot be told {}: {}", to, state, std::strerror(why));
}

void TellManagerOfReload() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const auto microseconds = int64_t{now.tv_sec} * 1'000'000 + now.tv_nsec / 1'000;
  TellManager("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(microseconds));
}

void TellManagerOfDrain(double seconds) {
  constexpr double kToEnd = 30;  // to abort calls, to shut gRPC down, and to free models
  TellManager(fmt::format("STOPPING=1\nSTATUS=drains for up to {} s\nEXTEND_TIMEOUT_USEC={:.0f}",
                          seconds, 1e6 * (seconds + kToEnd)));
}

// $WATCHDOG_PID names the intended process, because children inherit both variables.
void TellManagerOfLife() {
  static std::chrono::steady_clock::time_point next;
  const char* asked = std::getenv("WATCHDOG_USEC");
  if (asked == nullptr) return;
  const char* whom = std::getenv("WATCHDOG_PID");
  if (whom != nullptr && whom != std::to_string(getpid())) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < next) return;
  constexpr int kTellings = 4;
  next = now + std::chrono::microseconds(std::strtoll(asked, nullptr, 10) / kTellings);
  TellManager("WATCHDOG=1");
}

}  // namespace choreo
