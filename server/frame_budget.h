#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "model/engine/sample_queue.h"

namespace choreo {

/// Shares of the engines' time that may be promised.
struct FrameShares {
  double of_all = 0.9;  ///< for all calls together; the rest is for unmeasured work
  /// To the calls of one caller: while another is there, and while none is.
  double of_peer = 0.9, of_lone_peer = 0.9;
};

/// The engines' time, promised to calls as they come: each is charged its frames at their present
/// cost (SampleQueue::LoadOf) until it gives them back. A crowd is served as far as engines can,
/// and the rest is refused before it begins. Models share the devices, so their times add up; a
/// charged model outlives its calls. `party`: calls with the same one are counted together
/// (Caller::Party). Thread-safe.
class FrameBudget {
 public:
  /// `has_rival`: whether another caller than this party is there. While one is, a caller also
  /// leaves time for one call like its own.
  explicit FrameBudget(const FrameShares& shares,
                       std::function<bool(const std::string& party)> has_rival = {})
      : shares_(shares), has_rival_(std::move(has_rival)) {}

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
  /// The share of what may be promised that is promised: to all, or to the busiest caller. 1 as
  /// soon as one more like the largest call would be refused; 0 if nobody is refused.
  double utilisation() const;

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

  // Of one caller, beside which calls of `cost` come; does not require mutex_.
  double MostOf(const std::string& party, double cost) const;

  const FrameShares shares_;
  const std::function<bool(const std::string& party)> has_rival_;
  mutable std::mutex mutex_;
  std::map<const void*, Charge> charges_;  // by call. Lock: mutex_
};

}  // namespace choreo
