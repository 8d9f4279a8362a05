#include "server/connections/handshakes.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "model/core/joined.h"
#include "server/connections/caller.h"

namespace choreo {
namespace {

/// The most connections without a call to watch. Beyond it the oldest are dropped.
constexpr size_t kMostUnproven = 256;
constexpr size_t kMostNamed = 5;                      // peers named in one log line
constexpr std::chrono::seconds kBetweenTellings{10};  // as for gRPC's own lines

/// A reason in OpenSSL's words, and its index in kHandshakeFaults.
constexpr std::pair<std::string_view, size_t> kReasons[] = {
    {"peer did not return a certificate", 0},
    {"certificate verify failed", 1},
    {"alert unknown ca", 2},
    {"alert certificate", 2},
    {"alert bad certificate", 2},
    {"wrong version number", 3},
    {"http request", 3},
    {"unsupported protocol", 4},
    {"version too low", 4},
    {"Handshake timed out", 5},
};

std::array<std::atomic<uint64_t>, kHandshakeFaults.size()> fault_counts;

}  // namespace

void CountHandshakeFault(std::string_view line) {
  if (line.find("Handshake failed") == std::string_view::npos &&
      line.find("Handshake timed out") == std::string_view::npos)
    return;
  const auto* reason = std::ranges::find_if(
      kReasons, [line](const auto& one) { return line.find(one.first) != std::string_view::npos; });
  ++fault_counts[reason == std::end(kReasons) ? fault_counts.size() - 1 : reason->second];
}

void CountClientLeft() {
  constexpr size_t kClientLeft = kHandshakeFaults.size() - 2;
  static_assert(std::string_view(kHandshakeFaults[kClientLeft]) == "client_left");
  ++fault_counts[kClientLeft];
}

HandshakeFaults CountedHandshakeFaults() {
  HandshakeFaults faults{};
  std::ranges::copy(fault_counts, faults.begin());
  return faults;
}

void HandshakeWatch::Accepted(int connection) {
  std::string peer = PeerOf(connection);
  const std::lock_guard lock(mutex_);
  unproven_.push_back({connection, std::move(peer)});
  if (unproven_.size() > kMostUnproven) unproven_.pop_front();
}

void HandshakeWatch::Began(const std::string& peer) {
  const std::lock_guard lock(mutex_);
  std::erase_if(unproven_, [&](const Connection& one) { return one.peer == peer; });
}

// A closed descriptor has no peer, or another peer if its number has been reused.
std::vector<std::string> HandshakeWatch::TakeEnded() {
  std::vector<std::string> ended;
  std::erase_if(unproven_, [&](const Connection& one) {
    if (PeerOf(one.descriptor) == one.peer) return false;
    ended.push_back(one.peer);
    return true;
  });
  return ended;
}

void HandshakeWatch::Look() {
  const std::lock_guard lock(mutex_);
  const HandshakeFaults now = CountedHandshakeFaults();
  std::vector<std::string> ended = TakeEnded();
  if (now == told_) return;
  for (std::string& peer : ended) {
    if (ended_.size() < kMostNamed) ended_.push_back(std::move(peer));
  }
  const auto time = std::chrono::steady_clock::now();
  // The connection may end a moment after its handshake.
  if (time < next_report_ || ended_.empty()) return;
  std::vector<std::string> faults;
  for (size_t i = 0; i < now.size(); ++i) {
    if (now[i] > told_[i])
      faults.push_back(std::to_string(now[i] - told_[i]) + " " + kHandshakeFaults[i]);
  }
  spdlog::warn("TLS handshakes failed: {}; likely of {}", Joined(faults), Joined(ended_));
  told_ = now;
  ended_.clear();
  next_report_ = time + kBetweenTellings;
}

}  // namespace choreo
