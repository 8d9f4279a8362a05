#pragma once

#include <grpcpp/support/status.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "model/core/numbers/histogram.h"
#include "server/messages/refusal.h"
#include "server/telemetry/log.h"

namespace choreo {

/// Totals over all calls since the start. Thread-safe.
class Tally {
 public:
  static constexpr const char* kInfoMethod = "GetServerInfo";  ///< the call without a dance

  /// Numbers of calls by method and status.
  using Calls = std::map<std::pair<std::string, grpc::StatusCode>, uint64_t>;

  /// Numbers of refused calls by Refusal.
  using Refusals = std::array<uint64_t, kRefusals.size()>;

  /// Counts and logs a call that has ended.
  void Count(const CallRecord& call) {
    LogCall(call);
    frames += static_cast<uint64_t>(call.frames);
    if (call.frames > 0) first_frame_s.Add(call.first_frame_s);
    const std::lock_guard lock(mutex_);
    const auto kind = std::pair(std::string(call.method), call.status.error_code());
    ++calls_[kind];
    seconds_.try_emplace(kind, Histogram::CallSeconds()).first->second.Add(call.seconds);
    if (call.refusal) ++refusals_[static_cast<size_t>(*call.refusal)];
    if (call.method == kInfoMethod && !call.refusal) return;
    ++(call.refusal ? sum_.refused : sum_.served);
    if (call.caller.holder.empty()) return;
    Sum& own = of_holder_[call.caller.holder];
    ++(call.refusal ? own.refused : own.served);
  }
  Calls calls() const {
    const std::lock_guard lock(mutex_);
    return calls_;
  }
  /// Durations of calls by method and status. Omits kinds without calls.
  std::map<std::pair<std::string, grpc::StatusCode>, Histogram::Snapshot> seconds() const {
    const std::lock_guard lock(mutex_);
    std::map<std::pair<std::string, grpc::StatusCode>, Histogram::Snapshot> all;
    for (const auto& [kind, histogram] : seconds_) all.emplace(kind, histogram.snapshot());
    return all;
  }
  Refusals refusals() const {
    const std::lock_guard lock(mutex_);
    return refusals_;
  }

  /// Numbers of refused calls, and of all others that dance.
  struct Sum {
    uint64_t served = 0, refused = 0;
  };
  Sum sum() const {
    const std::lock_guard lock(mutex_);
    return sum_;
  }
  /// The numbers of one token holder's calls.
  Sum SumOf(const std::string& holder) const {
    const std::lock_guard lock(mutex_);
    const auto found = of_holder_.find(holder);
    return found == of_holder_.end() ? Sum{} : found->second;
  }

  std::atomic<uint64_t> frames = 0;        ///< received by ended calls
  std::atomic<uint64_t> dance_frames = 0;  ///< sent by all dances
  std::atomic<uint64_t> dances_resumed = 0;
  std::atomic<uint64_t> connections = 0;  ///< received, including refused ones
  std::array<std::atomic<uint64_t>, kConnectionRefusals.size()> refused_connections = {};
  Histogram first_frame_s{Histogram::Seconds()};
  Histogram sending_lateness_s{Histogram::Seconds()};  ///< of dance frames (Player)

  /// How good the dances of one model are.
  struct Quality {
    /// KeyReached::correction_m. Unlike raw_error_m, it differs between models.
    Histogram steered_m{{0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1}};
    Histogram support{
        {0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 0.99}};  ///< from each dance's QualityReport
  };
  /// The figures of the model with this name, at first without values. Valid as long as the tally.
  Quality& QualityOf(const std::string& model) const {
    const std::lock_guard lock(mutex_);
    return quality_[model];
  }

 private:
  mutable std::mutex mutex_;
  Calls calls_;                                                            // lock: mutex_
  std::map<std::pair<std::string, grpc::StatusCode>, Histogram> seconds_;  // lock: mutex_
  Refusals refusals_ = {};                                                 // lock: mutex_
  Sum sum_;                                                                // lock: mutex_
  std::map<std::string, Sum> of_holder_;                                   // lock: mutex_
  mutable std::map<std::string, Quality> quality_;                         // by model. Lock: mutex_
};

}  // namespace choreo
