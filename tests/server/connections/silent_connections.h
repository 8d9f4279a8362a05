#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <grpcpp/create_channel.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <string>
#include <vector>

#include "choreo/v1/choreography.grpc.pb.h"
#include "client/authoring/local_server.h"

namespace choreo {

/// Connections that say `greeting` and nothing more.
class SilentConnections {
 public:
  SilentConnections(const std::string& server, int count, const std::string& greeting = "") {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port =
        htons(static_cast<uint16_t>(std::stoi(server.substr(server.rfind(':') + 1))));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    for (int i = 0; i < count; ++i) {
      const int fd = socket(AF_INET, SOCK_STREAM, 0);
      EXPECT_EQ(connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
      fcntl(fd, F_SETFL, O_NONBLOCK);
      EXPECT_EQ(send(fd, greeting.data(), greeting.size(), MSG_NOSIGNAL), std::ssize(greeting));
      connections_.push_back(fd);
    }
  }
  ~SilentConnections() {
    for (const int fd : connections_) close(fd);
  }
  SilentConnections(const SilentConnections&) = delete;
  SilentConnections& operator=(const SilentConnections&) = delete;

  /// How many the server has closed.
  int Closed() const {
    int closed = 0;
    for (const int fd : connections_) {
      char byte;
      ssize_t count = 1;
      while (count > 0) count = recv(fd, &byte, 1, 0);  // the server greets first
      closed += count == 0 || errno != EAGAIN ? 1 : 0;
    }
    return closed;
  }

 private:
  std::vector<int> connections_;
};

/// Whether it answers somebody new within five seconds.
inline bool Serves(const authoring::LocalServer& server) {
  const auto channel = grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(5));
  v1::GetServerInfoResponse info;
  return v1::Choreography::NewStub(channel)->GetServerInfo(&context, {}, &info).ok();
}

}  // namespace choreo
