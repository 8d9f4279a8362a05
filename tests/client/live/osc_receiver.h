#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace choreo {

/// An OSC message: its address, and its arguments one after the other, by kind.
struct OscMessage {
  std::string path, types;
  std::vector<std::string> strings;
  std::vector<float> floats;
  std::vector<int32_t> ints;
};

/// One datagram, as the specification of OSC 1.0 reads it: a bundle of messages.
inline std::vector<OscMessage> ParseBundle(const std::string& datagram) {
  size_t at = 0;
  const auto number = [&] {
    uint32_t value = 0;
    std::memcpy(&value, datagram.data() + at, 4);
    at += 4;
    return ntohl(value);
  };
  const auto text = [&] {
    const std::string value = datagram.c_str() + at;
    at += (value.size() / 4 + 1) * 4;
    return value;
  };
  EXPECT_EQ(text(), "#bundle");
  at += 8;  // when
  std::vector<OscMessage> messages;
  while (at < datagram.size()) {
    const uint32_t size = number();
    const size_t end = at + size;
    OscMessage& message = messages.emplace_back();
    message.path = text();
    message.types = text();
    for (const char type : message.types.substr(1)) {
      if (type == 's') {
        message.strings.push_back(text());
        continue;
      }
      const uint32_t bits = number();
      if (type == 'i') message.ints.push_back(static_cast<int32_t>(bits));
      float value = 0;
      std::memcpy(&value, &bits, 4);
      if (type == 'f') message.floats.push_back(value);
    }
    EXPECT_EQ(at, end) << message.path;
    at = end;
  }
  return messages;
}

/// Takes all that comes to a UDP port of its own.
class OscReceiver {
 public:
  OscReceiver() : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), size), 0);
    getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { Receive(); });
  }
  ~OscReceiver() { Stop(); }

  int port() const { return port_; }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

  size_t count() const { return count_; }

  /// What has come, and nothing comes any more.
  std::vector<std::vector<OscMessage>> Stop() {
    if (thread_.joinable()) {
      // Datagrams of one machine come in the order in which they were sent.
      sockaddr_in self{};
      self.sin_family = AF_INET;
      self.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      self.sin_port = htons(static_cast<uint16_t>(port_));
      sendto(socket_, "", 0, 0, reinterpret_cast<sockaddr*>(&self), sizeof self);
      thread_.join();
      close(socket_);
    }
    std::vector<std::vector<OscMessage>> bundles;
    for (const std::string& datagram : datagrams_) bundles.push_back(ParseBundle(datagram));
    return bundles;
  }

 private:
  void Receive() {
    std::vector<char> buffer(1 << 16);
    ssize_t size = 0;
    while ((size = recv(socket_, buffer.data(), buffer.size(), 0)) > 0) {
      datagrams_.emplace_back(buffer.data(), static_cast<size_t>(size));
      ++count_;
    }
  }

  int socket_;
  int port_ = 0;
  std::vector<std::string> datagrams_;
  std::atomic<size_t> count_ = 0;
  std::thread thread_;
};

}  // namespace choreo
