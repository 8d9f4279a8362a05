#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <grpcpp/create_channel_posix.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/fixture.h"

/// Dances in real time, whose lateness is what others do to them.
namespace choreo {

/// A grant comes that often, and has so many frames.
inline constexpr std::chrono::milliseconds kGrant{100};
inline constexpr int64_t kFramesOfGrant = 3;

struct RealTimeDance {
  Answer answer;
  std::vector<double> lateness;  ///< seconds from each grant to its last frame
};

inline RealTimeDance DanceInRealTime(v1::Choreography::Stub& stub, v1::DanceConfig config,
                                     int grants) {
  using Clock = std::chrono::steady_clock;
  DanceClient client(stub);
  config.set_frames(grants * kFramesOfGrant);
  client.Send(config);
  RealTimeDance dance;
  Clock::time_point due = Clock::now();
  for (int64_t granted = kFramesOfGrant; granted <= config.frames(); granted += kFramesOfGrant) {
    std::this_thread::sleep_until(due);
    client.SendGenerateUntil(granted);
    if (!client.ReadFrames(granted)) break;
    dance.lateness.push_back(std::chrono::duration<double>(Clock::now() - due).count());
    due += kGrant;
  }
  dance.answer = client.Finish();
  return dance;
}

/// Of seconds; -1 of none.
inline double Milliseconds(std::vector<double> lateness, double share) {
  if (lateness.empty()) return -1;
  std::ranges::sort(lateness);
  return 1e3 * lateness[static_cast<size_t>(share * static_cast<double>(lateness.size() - 1))];
}

/// A client with an address of its own, 127.0.0.2: what others take from 127.0.0.1 is not its.
inline std::unique_ptr<v1::Choreography::Stub> StubOfAnotherAddress(int port) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  const auto local = [](const char* host, int of) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(of));
    inet_pton(AF_INET, host, &address.sin_addr);
    return address;
  };
  const sockaddr_in own = local("127.0.0.2", 0), server = local("127.0.0.1", port);
  EXPECT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&own), sizeof own), 0);
  EXPECT_EQ(connect(fd, reinterpret_cast<const sockaddr*>(&server), sizeof server), 0);
  fcntl(fd, F_SETFL, O_NONBLOCK);
  const int at_once = 1;  // as gRPC's own connections
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
  return v1::Choreography::NewStub(grpc::CreateInsecureChannelFromFd("choreod", fd));
}

}  // namespace choreo
