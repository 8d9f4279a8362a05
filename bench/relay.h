#pragma once

#include <string>
#include <thread>
#include <vector>

namespace choreo::bench {

/// Another address of this machine for clients: what they say at `address` reaches the server from
/// 127.0.0.`number`, and its answers come back. Each connection has two threads.
class Relay {
 public:
  /// `server`: 127.0.0.1:PORT. Throws Error(kUnavailable) where the machine has no such address.
  Relay(const std::string& server, int number);
  ~Relay();  ///< ends its connections
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  const std::string& address() const { return address_; }

 private:
  void Accept();
  static void Pass(int from, int to);

  int server_port_;
  int number_;
  int listening_;
  std::string address_;
  std::thread thread_;
  std::vector<int> sockets_;          // the thread's, until it is over
  std::vector<std::thread> passing_;  // so are these
};

}  // namespace choreo::bench
