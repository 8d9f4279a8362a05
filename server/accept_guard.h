#pragma once

#include <chrono>
#include <map>
#include <string>

#include "server/reset_guard.h"
#include "server/tally.h"

namespace choreo {

/// Decides which new connections gRPC gets: none of an address that has flooded it (FrameGuard,
/// ResetGuard), or has more reset calls than can be ended, or connects too fast. A handshake costs
/// CPU time that dances need, and each connection has its own bound on frames. For one thread.
class AcceptGuard {
 public:
  using Clock = std::chrono::steady_clock;

  /// `tally` counts what is decided. Both must outlive this.
  AcceptGuard(const ResetGuard& resets, Tally& tally) : resets_(resets), tally_(tally) {}

  /// Whether this socket may go on to gRPC; logs if it may not, once a second.
  bool Takes(int connection);
  /// Whether the address is not too fast.
  bool TakesFrom(const std::string& address, Clock::time_point now);

  /// All clients behind one address, whose server has begun anew, at once; after that as many a
  /// second.
  static constexpr int kAtOnce = 512, kPerSecond = 64;

 private:
  const ResetGuard& resets_;
  Tally& tally_;
  /// When all that an address has used of its rate is paid back; later ones only.
  std::map<std::string, Clock::time_point> paid_back_;
  Clock::time_point next_sweep_, next_report_;
};

}  // namespace choreo
