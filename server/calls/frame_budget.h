#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "model/engine/sample_queue.h"
#include "server/calls/serving_cost.h"
#include "server/process/time_source.h"

namespace choreo {

/// The shares of the machine's time that may be reserved.
struct FrameShares {
  double of_all = 0.85;  ///< for all calls; the rest is for other programs and for peaks
  /// For one caller, while another is connected and while none is.
  double of_caller = 0.85, of_lone_caller = 0.85;
};

/// Reserves the machine's time for calls as they arrive. Until GiveBack, each call is charged for
/// its frames at their current mean cost: the engines' (SampleQueue::LoadOf) and, for a dance, the
/// cost of serving. Beside these means, one dance of the costliest kind has time for kMaxTakes
/// takes, which a rare transition needs (plan/takes.h). The machine serves as many calls as it can,
/// and refuses the rest before they begin. Models share the devices, so their times add up. A
/// charged model outlives its calls. `caller`: the name of the caller to whom a call is counted
/// (Caller::Name). Thread-safe.
class FrameBudget {
 public:
  /// `has_rival`: whether another caller than this one is connected. While one is, a caller must
  /// leave time for one more call like its own. `serving`: the cost of serving; null charges
  /// nothing for it. `time` must outlive this.
  explicit FrameBudget(const FrameShares& shares,
                       std::function<bool(const std::string& caller)> has_rival = {},
                       const ServingCost* serving = nullptr,
                       const TimeSource& time = TimeSource::System())
      : has_rival_(std::move(has_rival)), serving_(serving), time_(time), shares_(shares) {}

  /// Reserves time for a dance at playing speed, however fast its music arrives. Throws Refused if
  /// it exceeds the time left. A lone caller's first call is always accepted, so that slow engines
  /// can serve one at a time. Call once per call. `call`: any address that identifies the call.
  void ReserveDance(const void* call, const SampleQueue& model, const std::string& caller);
  /// Reserves time for a transition of this many frames, summed over its candidates. Call once per
  /// call. Reserves at most half of all time, because a transition yields to dances anyway.
  void ReserveTransition(const void* call, const SampleQueue& model, const std::string& caller,
                         int frames);
  /// Reserves by these shares from now on; calls in progress keep their charges.
  void SetShares(const FrameShares& shares);
  /// Ends a call's charge. Ignores calls that were not charged.
  void GiveBack(const void* call) noexcept;

  /// Seconds after which the first of the charged transitions should be made, beside the dances and
  /// one after the other; 0 without any.
  double SecondsToRoom() const;

  /// Whether no transition was charged since the previous call of OnlyDanced.
  bool OnlyDanced();

  /// The reserved share of the machine's time, by model name.
  std::map<std::string, double> loads() const;
  /// The share of the budget in use by all calls or by the busiest caller, whichever is larger. 1
  /// once another call as large as the largest would be refused; 0 if the budget refuses nobody.
  double utilisation() const;

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;

  struct Charge {
    const SampleQueue* model;
    std::string caller;
    double frames_per_second;
    bool dances;
    double work = 0;              // of a transition: seconds of all of the machine's time
    Clock::time_point ends = {};  // when a transition should be made
  };

  void Reserve(const void* call, Charge charge);
  double LoadOf(const Charge& charge) const;

  // How long a further transition takes that needs `work`, behind the others. Requires mutex_.
  Seconds TimeFor(double work) const;

  // The load of all calls or, with `caller`, of one caller's calls, plus `more`. Requires mutex_.
  double LoadOf(const std::string* caller, const Charge* more = nullptr) const;

  // The most that all calls, including `more`, may reserve. Requires mutex_.
  double MostOfAll(const FrameShares& shares, const Charge* more = nullptr) const;

  // The functions below do not require mutex_. MostOf: the most that this caller may reserve if its
  // next call costs `cost`.
  double MostOf(const FrameShares& shares, const std::string& caller, double cost) const;
  FrameShares shares() const;

  const std::function<bool(const std::string& caller)> has_rival_;
  const ServingCost* const serving_;
  const TimeSource& time_;
  mutable std::mutex mutex_;
  FrameShares shares_;                     // lock: mutex_
  std::map<const void*, Charge> charges_;  // by call. Lock: mutex_
  bool only_danced_ = true;                // since the last OnlyDanced. Lock: mutex_
};

}  // namespace choreo
