#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "server/process/time_source.h"

namespace choreo {

/// The progress of a call.
struct CallProgress {
  bool unread = false;  ///< an answer waits for its client to take it
  /// When that answer was queued or, without one, when the last message in either direction came;
  /// now while workers sample.
  std::chrono::steady_clock::time_point since;
};

/// When a call ends.
enum class Ending {
  kAfterQueued,   ///< once its client has taken all queued answers
  kAfterCurrent,  ///< once its client has taken the answer being sent; drops the others
  kNow,           ///< even if its client reads nothing
};

/// A call in progress, for the registry.
class Call {
 public:
  virtual ~Call() = default;
  /// Ends the call with this error. The first error counts. Thread-safe.
  virtual void End(const Error& error, Ending ending) = 0;
  /// Ends the call after its queued answers if its token has been revoked. Thread-safe.
  virtual void EndIfRevoked() = 0;
  /// Logs the call as lost, because the process ends at once. Thread-safe.
  virtual void GiveUp() noexcept = 0;
  virtual CallProgress progress() const = 0;
};

/// Limits on clients' calls and idle time.
struct CallLimits {
  int calls = 0;
  /// The most calls of one caller, including calls without a first message: while another caller is
  /// connected, and while none is.
  int calls_of_caller = 0, calls_of_lone_caller = 0;
  std::chrono::milliseconds first_message{};
  std::chrono::milliseconds idle{};    ///< without messages in either direction
  std::chrono::milliseconds unread{};  ///< an answer was not taken
};

/// The status a call ends with when another server can resume it.
Error ResumeElsewhere();

/// The calls in progress. Limits their number and idle time, and ends them when the server drains.
/// A call enters when it begins, and is admitted with its first message, so that silent clients do
/// not take others' places. Thread-safe.
class CallRegistry {
 public:
  /// `time` must outlive this.
  explicit CallRegistry(const CallLimits& limits, const TimeSource& time = TimeSource::System())
      : time_(time), limits_(limits) {}

  /// `caller`: the name of the caller to whom the call is counted (Caller::Name). Throws Refused if
  /// the caller has too many calls, and after StopAdmitting.
  void Enter(const std::shared_ptr<Call>& call, std::string caller);
  /// Admits a call, once. Throws Refused when full, and after StopAdmitting.
  void Admit(const Call* call);
  /// Removes a call. Ignores calls that never entered.
  void Leave(const Call* call);

  /// Ends calls that have been idle for too long. Call regularly.
  void EndIdle();

  /// Ends calls whose tokens have been revoked. Call regularly.
  void EndRevoked();

  /// Gives up each admitted call (Call::GiveUp).
  void GiveUpAll();

  /// Admits no more calls, and ends calls not yet admitted.
  void StopAdmitting();
  /// From now on, streams end with ResumeElsewhere after their next continuation.
  void EndAtTransitions() { ends_at_transitions_ = true; }
  bool ends_at_transitions() const { return ends_at_transitions_; }
  void AbortAll(const Error& error);
  bool WaitUntilEmpty(std::chrono::milliseconds limit) const;

  /// Whether another caller than this one has a call, or had one within the last minute, which
  /// keeps a place for a refused caller's retry.
  bool HasRival(const std::string& caller) const;

  bool admitting() const;  ///< until StopAdmitting
  int count() const;       ///< admitted
  /// The calls of one caller, including calls without a first message.
  int CountOf(const std::string& caller) const;
  CallLimits limits() const;
  /// Limits calls from now on; calls in progress stay, even if they are more.
  void SetLimits(const CallLimits& limits);
  const TimeSource& time() const { return time_; }
  /// The share in use of the limit on all calls, or of the busiest caller's limit, whichever is
  /// larger.
  double utilisation() const;
  /// Seconds, 1 to 60, after which a refused call should retry: about when as many calls will have
  /// ended as were refused before it, but not before `room` seconds, in which no call is expected
  /// to end. Randomised, so that retries do not coincide.
  double RetryAfter(double room = 0);
  /// RetryAfter for a client that has other servers to try.
  double RetryElsewhere();

 private:
  using Clock = std::chrono::steady_clock;
  struct Entry {
    std::weak_ptr<Call> call;
    std::string caller;
    Clock::time_point since;  // when it entered, or was admitted
    bool admitted = false;
  };

  /// A caller's latest arrival.
  struct Visit {
    std::string caller;
    Clock::time_point at;
  };

  // These require mutex_.
  std::vector<std::shared_ptr<Call>> Calls(std::optional<bool> admitted = std::nullopt) const;
  bool IsRivalled(const std::string& caller) const;
  int MostOf(const std::string& caller) const;
  double Spread(double seconds);

  const TimeSource& time_;
  std::atomic<bool> ends_at_transitions_ = false;
  mutable std::mutex mutex_;  // guards the members below
  CallLimits limits_;
  mutable std::condition_variable left_;
  std::map<const Call*, Entry> calls_;
  std::map<std::string, int> of_caller_;
  int admitted_ = 0;
  bool admitting_ = true;
  std::array<Visit, 2> visits_;  // the latest caller, and the latest other one
  double mean_seconds_ = 0;      // mean duration of recently ended calls
  int64_t ended_ = 0;
  int refused_ = 0;  // refused calls for which no ended call has yet made room
  std::minstd_rand random_{std::random_device{}()};
};

}  // namespace choreo
