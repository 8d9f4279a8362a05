#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace choreo {

/// Takes connections and hands them on. gRPC's own listener is not used: once the process is out of
/// descriptors it never accepts again. This one refuses connections (closes them at once, so that
/// clients go elsewhere) while some descriptors are still left for everything else, and goes on
/// when there are more again. Thread-safe.
class Listener {
 public:
  /// Called from the listener's thread; from then on the connection belongs to the callee. It
  /// blocks nowhere and waits for nothing before it sends.
  using Accept = std::function<void(int listening, int connection)>;

  /// Listens on HOST:PORT, wherever HOST is; port 0 takes a free one. Connections wait until Start.
  /// Throws Error(kUnavailable, field).
  explicit Listener(const std::string& address, const std::string& field = "--listen");
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int port() const { return port_; }
  void Start(Accept accept);
  /// Nobody is accepted any more, and those who wait are sent away. Idempotent.
  void Stop();

 private:
  void Work(const Accept& accept);
  /// Whoever waits at this socket.
  void AcceptAll(int listening, const Accept& accept);
  void Pause();

  std::vector<int> sockets_;
  int port_ = 0;
  int stop_ = -1;  // an eventfd
  std::thread thread_;
  // Of the thread.
  int64_t refused_ = 0;  // since the last report
  std::chrono::steady_clock::time_point next_report_;
};

/// Whether HOST:PORT can be reached from this machine alone. So is a host without an
/// address, at which nobody can listen.
bool IsLocal(const std::string& address);

/// Lets the process have as many descriptors as it may ask for.
void RaiseDescriptorLimit();

}  // namespace choreo
