#include "bench/relay.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "model/core/error.h"

namespace choreo::bench {
namespace {

sockaddr_in Local(int number, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(port));
  address.sin_addr.s_addr = htonl(0x7F000000U + static_cast<uint32_t>(number));
  return address;
}

void Require(bool done, const char* what) {
  if (!done) throw Error(ErrorCode::kUnavailable, "", std::string(what) + std::strerror(errno));
}

// A socket bound to 127.0.0.`number`.
int Bound(int number) {
  const int made = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  Require(made >= 0, "no socket: ");
  const int on = 1;
  setsockopt(made, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  const sockaddr_in address = Local(number, 0);
  Require(bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0,
          "an address of this machine can't be had: ");
  return made;
}

}  // namespace

Relay::Relay(const std::string& server, int number)
    : server_port_(std::stoi(server.substr(server.rfind(':') + 1))),
      number_(number),
      listening_(Bound(1)) {
  close(Bound(number));  // fails here if the address is unavailable
  Require(listen(listening_, SOMAXCONN) == 0, "a relay can't listen: ");
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size);
  address_ = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  thread_ = std::thread([this] { Accept(); });
}

Relay::~Relay() {
  shutdown(listening_, SHUT_RDWR);
  thread_.join();
  for (const int open : sockets_) shutdown(open, SHUT_RDWR);
  for (std::thread& passing : passing_) passing.join();
  for (const int open : sockets_) close(open);
  close(listening_);
}

void Relay::Accept() {
  const sockaddr_in server = Local(1, server_port_);
  for (int client = -1; (client = accept(listening_, nullptr, nullptr)) >= 0;) {
    sockets_.push_back(client);
    const int on = 1;
    setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    const int up = sockets_.emplace_back(Bound(number_));
    if (connect(up, reinterpret_cast<const sockaddr*>(&server), sizeof server) != 0) {
      shutdown(client, SHUT_RDWR);
      continue;
    }
    passing_.emplace_back([client, up] { Pass(client, up); });
    passing_.emplace_back([client, up] { Pass(up, client); });
  }
}

// Copies until either side closes.
void Relay::Pass(int from, int to) {
  std::array<char, 65536> bytes;
  for (ssize_t count = 0; (count = recv(from, bytes.data(), bytes.size(), 0)) > 0;)
    if (send(to, bytes.data(), static_cast<size_t>(count), MSG_NOSIGNAL) != count) break;
  shutdown(from, SHUT_RDWR);
  shutdown(to, SHUT_RDWR);
}

}  // namespace choreo::bench
