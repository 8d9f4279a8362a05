#pragma once

#include <chrono>
#include <map>
#include <string>

#include "server/connections/reset_guard.h"
#include "server/telemetry/tally.h"

namespace choreo {

/// Decides which new connections are passed to gRPC. Refuses an address that has flooded the server
/// (FrameGuard, ResetGuard), has reset more calls than can be ended, or connects too fast.
/// Handshakes cost CPU time that dances need, and each connection has its own limit on frames. Not
/// thread-safe.
class AcceptGuard {
 public:
  using Clock = std::chrono::steady_clock;

  /// `tally` counts the decisions. Both must outlive this.
  AcceptGuard(const ResetGuard& resets, Tally& tally) : resets_(resets), tally_(tally) {}

  /// Whether this socket may be passed to gRPC. Logs refusals, at most once a second.
  bool Takes(int connection);
  /// Whether the address connects slowly enough.
  bool TakesFrom(const std::string& address, Clock::time_point now);

  /// The allowed burst of connections from one address, for clients that reconnect after a server's
  /// restart, and the sustained rate after it.
  static constexpr int kAtOnce = 512, kPerSecond = 64;

 private:
  const ResetGuard& resets_;
  Tally& tally_;
  /// By address: when it will have regained its full burst. Holds future times only.
  std::map<std::string, Clock::time_point> paid_back_;
  Clock::time_point next_sweep_, next_report_;
};

}  // namespace choreo
