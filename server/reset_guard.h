#pragma once

#include <grpcpp/server_builder.h>

#include <map>
#include <mutex>
#include <string>

namespace choreo {

/// Calls that were begun and are not done yet, of each connection. gRPC forgets a call
/// when its client resets it, but its memory is taken until somebody has had the time to end it: so
/// a client that begins and resets without end would take all there is. A connection that has more
/// than `most` such calls is closed, and until they are done its address gets no other one.
/// Thread-safe.
class ResetGuard {
 public:
  explicit ResetGuard(int most) : most_(most) {}

  /// Has it see every call of the server, which it outlives.
  void Watch(grpc::ServerBuilder* builder);

  /// Whether no more connections are taken from where this socket's peer is.
  bool IsFull(int connection) const;

  /// A call begins, and is done; `peer` as gRPC has it: an address and a port. Empty, as it is for
  /// gRPC's own services: it is not counted.
  void Enter(const std::string& peer);
  void Leave(const std::string& peer);

 private:
  struct Connection {
    int calls = 0;
    bool closed = false;  ///< for having too many
  };

  const int most_;
  mutable std::mutex mutex_;
  std::map<std::string, Connection> connections_;  // with calls, by peer. Lock: mutex_
};

}  // namespace choreo
