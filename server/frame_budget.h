#pragma once

#include <map>
#include <mutex>
#include <string>

#include "model/engine/sample_queue.h"

namespace choreo {

/// Shares of the engines' time that may be promised.
struct FrameShares {
  double of_all = 0.9;   ///< for all calls together; the rest is for unmeasured work
  double of_peer = 0.9;  ///< to the calls of one caller
};

/// The engines' time, promised to calls as they come: each is charged its frames at their present
/// cost (SampleQueue::LoadOf) until it gives them back. A crowd is served as far as engines can,
/// and the rest is refused before it begins. Models share the devices, so their times add up; a
/// charged model outlives its calls. `party`: calls with the same one are counted together
/// (Caller::Party). Thread-safe.
class FrameBudget {
 public:
  explicit FrameBudget(const FrameShares& shares) : shares_(shares) {}

  /// Charges a dance, which runs at playing speed, whenever its music comes. Throws Refused if it
  /// exceeds what is left. A lone caller is always accepted: slow engines serve one at a time. Once
  /// per call, which any address of its own identifies.
  void TakeDance(const void* call, const SampleQueue& model, const std::string& party);
  /// Charges a transition of this many frames, candidates included; may be called repeatedly.
  /// Charges at most half of all time, however long it is: it yields to dances anyway.
  void TakeTransition(const void* call, const SampleQueue& model, const std::string& party,
                      int frames);
  /// Also for calls that took nothing.
  void GiveBack(const void* call) noexcept;

  /// The promised share of the engines' time, by model name.
  std::map<std::string, double> loads() const;
  const FrameShares& shares() const { return shares_; }

 private:
  struct Charge {
    const SampleQueue* model;
    std::string party;
    double frames_per_second;
  };

  void Take(const void* call, Charge charge);
  using Frames = std::map<const SampleQueue*, double>;  // per second

  // Requires mutex_. Of all calls, or of one caller's.
  Frames FramesOf(const std::string* party) const;

  const FrameShares shares_;
  mutable std::mutex mutex_;
  std::map<const void*, Charge> charges_;  // by call. Lock: mutex_
};

}  // namespace choreo
