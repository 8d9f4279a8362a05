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

/// Reasons why TLS handshakes fail, as named in /metrics. The last covers all other reasons.
inline constexpr std::array kHandshakeFaults = {
    "no_client_certificate",
    "bad_client_certificate",
    "server_certificate_refused",
    "not_tls",
    "old_version",
    "timed_out",
    "client_left",
    "other",
};
using HandshakeFaults = std::array<uint64_t, kHandshakeFaults.size()>;

/// Counts a failed handshake if this line of gRPC's log reports one. gRPC 1.51 reports them nowhere
/// else. Thread-safe.
void CountHandshakeFault(std::string_view line);
/// Counts a handshake that its client ended without a word, as gRPC's clients do when they distrust
/// the server's certificate. gRPC 1.51 does not report it. Thread-safe.
void CountClientLeft();
/// The number of failed handshakes in this process, by reason. Thread-safe.
HandshakeFaults CountedHandshakeFaults();

/// Logs the likely peers of failed handshakes, whom gRPC does not name: connections that ended
/// without a call at about that time. Thread-safe.
class HandshakeWatch {
 public:
  /// Records a new connection.
  void Accepted(int connection);
  /// Records a call of this peer, in the form of PeerOf.
  void Began(const std::string& peer);
  /// Logs the failures since the last call. Call regularly.
  void Look();

 private:
  struct Connection {
    int descriptor;
    std::string peer;
  };
  std::vector<std::string> TakeEnded();

  std::mutex mutex_;                 // guards the members below
  std::deque<Connection> unproven_;  // connections without a call, oldest first
  HandshakeFaults told_ = CountedHandshakeFaults();
  std::vector<std::string> ended_;  // not yet logged
  std::chrono::steady_clock::time_point next_report_;
};

}  // namespace choreo
