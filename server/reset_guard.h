#pragma once

#include <grpcpp/server_builder.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "server/held_off.h"

namespace choreo {

/// Counts unfinished calls per connection. gRPC forgets a call when its client resets it, but its
/// memory is in use until it is cleaned up, so endless resets would exhaust memory. Closes a
/// connection with more than `most` such calls, counts it among the floods and holds its address
/// off. Accepts no other connection from there until these calls are cleaned up. Thread-safe.
class ResetGuard {
 public:
  /// `on_call`: told the peer of each call that begins.
  explicit ResetGuard(int most, std::function<void(const std::string&)> on_call = {})
      : most_(most), on_call_(std::move(on_call)) {}

  /// Watches every call of the server, which must not outlive this.
  void Watch(grpc::ServerBuilder* builder);

  /// Whether the address of this socket's peer gets no more connections.
  bool IsFull(int connection) const;

  /// The addresses that get no connection for a while, whatever they flooded with.
  const std::shared_ptr<HeldOff>& held_off() const { return held_off_; }

  /// Call when a call begins, and when it is done. `peer` is gRPC's: an address and a port. An
  /// empty one, of gRPC's own services, is not counted.
  void Enter(const std::string& peer);
  void Leave(const std::string& peer);

 private:
  struct Connection {
    int calls = 0;
    bool closed = false;  ///< for having too many
  };

  const int most_;
  const std::function<void(const std::string&)> on_call_;
  const std::shared_ptr<HeldOff> held_off_ = std::make_shared<HeldOff>();
  mutable std::mutex mutex_;
  std::map<std::string, Connection> connections_;  // those with calls, by peer. Lock: mutex_
};

}  // namespace choreo
