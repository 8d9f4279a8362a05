#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>

#include "server/connections/reset_guard.h"
#include "server/telemetry/tally.h"

namespace choreo {

/// Decides which new connections are passed to gRPC. Refuses an address that flooded the server
/// (FrameGuard, ResetGuard), has reset more calls than can be ended, or connects too fast:
/// handshakes cost CPU time that dances need, and limits on frames are per connection. `Takes` is
/// not thread-safe.
class AcceptGuard {
 public:
  using Clock = std::chrono::steady_clock;

  /// `tally` counts the decisions. Both must outlive this.
  AcceptGuard(const ResetGuard& resets, Tally& tally) : resets_(resets), tally_(tally) {}

  /// Whether this socket may be passed to gRPC. Otherwise counts it (Refuse).
  bool Takes(int connection);
  /// Counts a refused connection of this address, and logs it unless a line was logged within the
  /// last minute. Thread-safe.
  void Refuse(const std::string& address, ConnectionRefusal why, Clock::time_point now);
  /// Logs how many were refused without a line, once a minute is over. Call regularly. Thread-safe.
  void Report(Clock::time_point now);
  /// The same, at once, before the server ends.
  void ReportRest();
  /// Whether the address connects slowly enough.
  bool TakesFrom(const std::string& address, Clock::time_point now);

  /// Connections allowed from one address: at once, for clients that reconnect after a server's
  /// restart, and per second after that.
  static constexpr int kAtOnce = 512, kPerSecond = 64;

 private:
  void Log();  // requires mutex_

  const ResetGuard& resets_;
  Tally& tally_;
  /// By address: the future time at which its full burst is allowed again.
  std::map<std::string, Clock::time_point> paid_back_;
  Clock::time_point next_sweep_;
  std::mutex mutex_;  // guards the members below
  Clock::time_point next_report_;
  std::string latest_;  // the latest refusal, in words
  int untold_ = 0;      // refusals since the latest line
};

}  // namespace choreo
