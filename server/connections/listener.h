#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace choreo {

/// Accepts connections and passes them on. Replaces gRPC's listener, which stops accepting for good
/// once the process has run out of descriptors. This one keeps some descriptors in reserve. When
/// only these are left, it closes new connections at once, so that clients go elsewhere, until more
/// are free. Thread-safe.
class Listener {
 public:
  /// Called on the listener's thread. The callee takes ownership of the connection and must not
  /// block.
  using Accept = std::function<void(int listening, int connection)>;

  /// Listens on HOST:PORT; port 0 picks a free port. Connections wait until Start. Throws
  /// Error(field): kInvalidArgument if the host has no address or one of another machine, else
  /// kUnavailable.
  explicit Listener(const std::string& address, const std::string& field = "--listen");
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int port() const { return port_; }
  void Start(Accept accept);
  /// Stops accepting and closes waiting connections. Idempotent.
  void Stop();

 private:
  void Work(const Accept& accept);
  /// Accepts all connections waiting at this socket.
  void AcceptAll(int listening, const Accept& accept);
  void Pause();

  std::vector<int> sockets_;
  int port_ = 0;
  int stop_ = -1;  // an eventfd
  std::thread thread_;
  // Only the thread uses these.
  int64_t refused_ = 0;  // since the last report
  std::chrono::steady_clock::time_point next_report_;
};

/// Throws what Listener would throw for a host that has no address, or none of this machine. The
/// port may be in use.
void RequireOwnAddress(const std::string& address, const std::string& field);

/// Whether HOST:PORT is reachable from this machine only. Also true for a host without an address,
/// on which nobody can listen.
bool IsLocal(const std::string& address);

/// Raises the process's descriptor limit as far as allowed.
void RaiseDescriptorLimit();

}  // namespace choreo
