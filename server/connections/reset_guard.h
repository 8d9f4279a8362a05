#pragma once

#include <grpcpp/server_builder.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "server/connections/held_off.h"

namespace choreo {

/// Counts unfinished calls per connection. gRPC no longer counts a call that its client reset,
/// though its memory is in use until it is cleaned up, so endless resets would exhaust memory.
/// Closes a connection with more than `most` such calls, counts it as a flood, and holds its
/// address off. Refuses new connections from that address until these calls are cleaned up.
/// Thread-safe.
class ResetGuard {
 public:
  /// `most`: unfinished calls per connection. `on_call`: gets the peer of each new call.
  explicit ResetGuard(int most, std::function<void(const std::string&)> on_call = {})
      : most_(most), on_call_(std::move(on_call)) {}

  /// Watches every call of the server being built. The server must not outlive this.
  void Watch(grpc::ServerBuilder* builder);

  /// Whether the address of this socket's peer may open no more connections.
  bool IsFull(int connection) const;

  /// The addresses held off after any kind of flood.
  const std::shared_ptr<HeldOff>& held_off() const { return held_off_; }

  /// Call Enter when a call begins and Leave when it is done. `peer`: gRPC's address and port.
  /// Calls to gRPC's own services have an empty peer, and are not counted.
  void Enter(const std::string& peer);
  void Leave(const std::string& peer);

 private:
  struct Connection {
    int calls = 0;
    bool closed = false;  ///< because it had too many calls
  };

  const int most_;
  const std::function<void(const std::string&)> on_call_;
  const std::shared_ptr<HeldOff> held_off_ = std::make_shared<HeldOff>();
  mutable std::mutex mutex_;
  std::map<std::string, Connection> connections_;  // connections with calls, by peer. Lock: mutex_
};

}  // namespace choreo
