#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <mutex>

namespace choreo {

/// The results of a running server's latest attempts to reread files. Thread-safe.
class Reloads {
 public:
  enum What { kModels, kTokens, kCertificate, kSettings };
  /// Names in /metrics, in the order of the enum.
  static constexpr std::array kNames = {"models", "tokens", "certificate", "settings"};

  struct State {
    bool good = true;
    double succeeded_at = 0;  ///< the latest success, including startup; seconds since 1970
  };
  using States = std::array<State, kNames.size()>;

  Reloads() {
    for (State& state : states_) state.succeeded_at = Now();
  }

  void Note(What what, bool good) {
    const std::lock_guard lock(mutex_);
    states_[what].good = good;
    if (good) states_[what].succeeded_at = Now();
  }
  States states() const {
    const std::lock_guard lock(mutex_);
    return states_;
  }

  std::atomic<double> certificate_expires = 0;  ///< seconds since 1970; 0: no TLS
  std::atomic<double> client_ca_expires = 0;    ///< seconds since 1970; 0: no --tls-client-ca

 private:
  static double Now() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
  }

  mutable std::mutex mutex_;
  States states_;  // lock: mutex_
};

}  // namespace choreo
