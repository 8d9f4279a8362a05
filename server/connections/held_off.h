#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>

namespace choreo {

/// Addresses that flooded the server and may not connect for a while. Thread-safe.
class HeldOff {
 public:
  using Clock = std::chrono::steady_clock;
  /// How long an address is held off: much longer than it takes to end a flood.
  static constexpr std::chrono::seconds kTime{10};

  void Add(const std::string& address, Clock::time_point now = Clock::now()) {
    const std::lock_guard lock(mutex_);
    std::erase_if(until_, [now](const auto& one) { return one.second <= now; });
    until_[address] = now + kTime;
  }
  bool Has(const std::string& address, Clock::time_point now = Clock::now()) const {
    const std::lock_guard lock(mutex_);
    const auto found = until_.find(address);
    return found != until_.end() && found->second > now;
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, Clock::time_point> until_;  // lock: mutex_
};

}  // namespace choreo
