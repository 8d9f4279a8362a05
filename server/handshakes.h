#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace choreo {

/// Why TLS handshakes fail; names in /metrics. The last stands for all other reasons.
inline constexpr std::array kHandshakeFaults = {
    "no_client_certificate",
    "bad_client_certificate",
    "server_certificate_refused",
    "not_tls",
    "old_version",
    "timed_out",
    "other",
};
using HandshakeFaults = std::array<uint64_t, kHandshakeFaults.size()>;

/// Counts the failed handshake that a line of gRPC's log reports, if it reports one: gRPC 1.51
/// reports them nowhere else. Thread-safe.
void CountHandshakeFault(std::string_view line);
/// Failed handshakes of this process. Thread-safe.
HandshakeFaults CountedHandshakeFaults();

/// Logs the likely peers of failed handshakes, which gRPC does not name: connections that ended at
/// that time without a call. Thread-safe.
class HandshakeWatch {
 public:
  /// A new connection.
  void Accepted(int connection);
  /// A call of this peer, in the form of PeerOf.
  void Began(const std::string& peer);
  /// Logs what has failed since the last time. Call regularly.
  void Look();

 private:
  struct Connection {
    int descriptor;
    std::string peer;
  };
  std::vector<std::string> TakeEnded();

  std::mutex mutex_;                 // guards the members below
  std::deque<Connection> unproven_;  // those without a call, oldest first
  HandshakeFaults told_ = CountedHandshakeFaults();
  std::vector<std::string> ended_;  // not yet told
  std::chrono::steady_clock::time_point next_report_;
};

}  // namespace choreo
