#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "model/core/error.h"

namespace choreo {

/// How far a call has come.
struct CallProgress {
  bool unread = false;  ///< an answer waits for its client to take it
  /// Since when: that answer, or that nothing came and nothing went.
  std::chrono::steady_clock::time_point since;
};

/// A call in progress, as the registry sees it.
class Call {
 public:
  virtual ~Call() = default;
  /// Ends the call with this error as soon as its client has taken the answer that is on its way;
  /// from any thread.
  virtual void Abort(const Error& error) = 0;
  /// Ends the call although its client takes nothing: as CANCELLED. From any thread.
  virtual void Reset() = 0;
  virtual CallProgress progress() const = 0;
};

/// What clients may take, and for how long they may do nothing.
struct CallLimits {
  int calls = 0;
  int calls_of_peer = 0;  ///< of one caller, those without a first message included
  std::chrono::milliseconds first_message{};
  std::chrono::milliseconds idle{};    ///< nothing came and nothing went
  std::chrono::milliseconds unread{};  ///< an answer was not taken
};

/// With what a call ends that another server can go on with.
Error HandedOn();

/// The calls in progress: how many there may be, how long each may stand still, and how they end
/// when the server drains. A call enters when it begins and is admitted with its first message: who
/// says nothing takes nobody's place. Thread-safe.
class CallRegistry {
 public:
  explicit CallRegistry(const CallLimits& limits) : limits_(limits) {}

  /// `party`: whose calls are counted together (Caller::Party). Throws Refused where these are too
  /// many, and after StopAdmitting.
  void Enter(const std::shared_ptr<Call>& call, std::string party);
  /// Throws Refused when full, and after StopAdmitting. Once for each call.
  void Admit(const Call* call);
  /// Also for calls that never entered.
  void Leave(const Call* call);

  /// Ends the calls that have stood still for too long. To be called every now and then.
  void EndIdle();

  /// Calls that were not admitted end, too.
  void StopAdmitting();
  /// Streams end with their next continuation, as HandedOn.
  void EndAtTransitions() { ends_at_transitions_ = true; }
  bool ends_at_transitions() const { return ends_at_transitions_; }
  void AbortAll(const Error& error);
  bool WaitUntilEmpty(std::chrono::milliseconds limit) const;

  bool admitting() const;  ///< until StopAdmitting
  int count() const;       ///< admitted
  const CallLimits& limits() const { return limits_; }
  /// When a place may be free: by how often calls have ended lately. Seconds, 1 to 60.
  double retry_after() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Entry {
    std::weak_ptr<Call> call;
    std::string party;
    Clock::time_point since;  // it entered, or was admitted
    bool admitted = false;
  };

  // With mutex_ held.
  std::vector<std::shared_ptr<Call>> Calls(bool admitted) const;

  const CallLimits limits_;
  std::atomic<bool> ends_at_transitions_ = false;
  mutable std::mutex mutex_;  // guards all below
  mutable std::condition_variable left_;
  std::map<const Call*, Entry> calls_;
  std::map<std::string, int> of_party_;
  int admitted_ = 0;
  bool admitting_ = true;
  double mean_seconds_ = 0;  // of the calls that ended lately
};

}  // namespace choreo
