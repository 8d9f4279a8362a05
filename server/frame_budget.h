#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "model/engine/sample_queue.h"
#include "server/serving_cost.h"

namespace choreo {

/// Shares of the machine's time that may be promised.
struct FrameShares {
  double of_all = 0.85;  ///< all calls' share; the rest is for others and for peaks
  /// One caller's share while another is there, and while none is.
  double of_peer = 0.85, of_lone_peer = 0.85;
};

/// Promises the machine's time to calls as they come. Each is charged its frames at their present
/// cost until it gives them back: the engines' (SampleQueue::LoadOf) and, for a dance, that of
/// serving it. The machine serves as many calls as it can, and refuses the rest before they begin.
/// Models share the devices, so their times add up; a charged model outlives its calls. `party`:
/// calls with the same one are counted together (Caller::Party). Thread-safe.
class FrameBudget {
 public:
  /// `has_rival`: whether another caller than this party is there. While one is, a caller also
  /// leaves time for one call like its own. `serving`: null charges nothing for it.
  explicit FrameBudget(const FrameShares& shares,
                       std::function<bool(const std::string& party)> has_rival = {},
                       const ServingCost* serving = nullptr)
      : shares_(shares), has_rival_(std::move(has_rival)), serving_(serving) {}

  /// Charges a dance, which runs at playing speed, whenever its music comes. Throws Refused if it
  /// exceeds what is left. A lone caller is always accepted: slow engines serve one at a time. Call
  /// it once per call, which any address of its own identifies.
  void TakeDance(const void* call, const SampleQueue& model, const std::string& party);
  /// Charges a transition of this many frames, candidates included; once per call, too. Charges at
  /// most half of all time, however long it is: it yields to dances anyway.
  void TakeTransition(const void* call, const SampleQueue& model, const std::string& party,
                      int frames);
  /// Accepts calls that took nothing.
  void GiveBack(const void* call) noexcept;

  /// Whether nobody was charged a transition since the last OnlyDanced.
  bool OnlyDanced();

  /// The promised share of the machine's time, by model name.
  std::map<std::string, double> loads() const;
  /// The share of the budget in use, by all calls or by the busiest caller, the larger. 1 once
  /// another call as large as the largest would be refused; 0 if the budget refuses nobody.
  double utilisation() const;

 private:
  struct Charge {
    const SampleQueue* model;
    std::string party;
    double frames_per_second;
    bool dances;
  };

  void Take(const void* call, Charge charge);
  double LoadOf(const Charge& charge) const;

  // The load of all calls, or of one caller's, and of one more. Requires mutex_.
  double LoadOf(const std::string* party, const Charge* more = nullptr) const;

  // The most that this caller may take while calls of `cost` come. Does not require mutex_.
  double MostOf(const std::string& party, double cost) const;

  const FrameShares shares_;
  const std::function<bool(const std::string& party)> has_rival_;
  const ServingCost* const serving_;
  mutable std::mutex mutex_;
  std::map<const void*, Charge> charges_;  // by call. Lock: mutex_
  bool only_danced_ = true;                // except transitions still in progress. Lock: mutex_
};

}  // namespace choreo
