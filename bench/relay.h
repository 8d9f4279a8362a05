#pragma once

#include <string>
#include <thread>
#include <vector>

namespace choreo::bench {

/// Gives clients another address on this machine: connections to `address` reach the server from
/// 127.0.0.`number`. Uses two threads per connection.
class Relay {
 public:
  /// `server`: 127.0.0.1:PORT. Throws Error(kUnavailable) if the machine has no such address.
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
  std::vector<int> sockets_;          // owned by the thread until it ends
  std::vector<std::thread> passing_;  // so are these
};

}  // namespace choreo::bench
