#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>

#include "model/core/error.h"

namespace choreo {

/// A call in progress, as the registry sees it.
class Call {
 public:
  virtual ~Call() = default;
  /// Ends the call with this error, soon; from any thread.
  virtual void Abort(const Error& error) = 0;
};

/// The calls in progress: how many there may be, and how they end when the server drains.
/// Thread-safe.
class CallRegistry {
 public:
  explicit CallRegistry(int max_calls) : max_calls_(max_calls) {}

  /// Throws Error(kResourceExhausted) when full, Error(kUnavailable) after StopAdmitting.
  void Enter(const std::shared_ptr<Call>& call);
  /// Also for calls that never entered.
  void Leave(const Call* call);

  void StopAdmitting();
  void AbortAll(const Error& error);
  bool WaitUntilEmpty(std::chrono::milliseconds limit) const;

  int count() const;
  int max_calls() const { return max_calls_; }
  uint64_t total() const;    ///< ever admitted
  uint64_t refused() const;  ///< for want of room

 private:
  const int max_calls_;
  mutable std::mutex mutex_;  // guards all below
  mutable std::condition_variable left_;
  std::map<const Call*, std::weak_ptr<Call>> calls_;
  bool admitting_ = true;
  uint64_t total_ = 0;
  uint64_t refused_ = 0;
};

}  // namespace choreo
