#pragma once

#include <map>
#include <mutex>
#include <string>

#include "model/engine/sample_queue.h"

namespace choreo {

/// How much of the engines' time there is to promise.
struct FrameShares {
  double of_all = 0.9;   ///< to all calls together; the rest is for what is not measured
  double of_peer = 0.9;  ///< to those of one caller
};

/// The engines' time, promised to calls as they come: each is charged with the frames that it will
/// take, at what frames cost now (SampleQueue::LoadOf), until it gives them back. So a crowd that
/// comes at once is served as far as the engines can, and the rest is told so before it begins.
/// Models share the devices, so the times of all are one; a model that calls are charged with
/// outlives them. `party`: whose calls are counted together (Caller::Party). Thread-safe.
class FrameBudget {
 public:
  explicit FrameBudget(const FrameShares& shares) : shares_(shares) {}

  /// A dance: it goes on as fast as it is played, whenever its music comes. Throws
  /// Refused where that is more than is left. Who is alone is always taken: slow
  /// engines serve one at a time. Once for each call, named by any address that is its own.
  void TakeDance(const void* call, const SampleQueue& model, const std::string& party);
  /// A transition of so many frames, candidates counted; as often as it asks to be made. It is
  /// charged with half of all time at most, however long it is: it yields to dances anyway.
  void TakeTransition(const void* call, const SampleQueue& model, const std::string& party,
                      int frames);
  /// Also for calls that took nothing.
  void GiveBack(const void* call) noexcept;

  /// The share of the engines' time that is promised, by the name of the model.
  std::map<std::string, double> loads() const;
  const FrameShares& shares() const { return shares_; }

 private:
  struct Charge {
    const SampleQueue* model;
    std::string party;
    double frames_per_second;
  };

  void Take(const void* call, Charge charge);
  using Frames = std::map<const SampleQueue*, double>;  // a second

  // With mutex_ held: of all calls, or of those of one caller.
  Frames FramesOf(const std::string* party) const;

  const FrameShares shares_;
  mutable std::mutex mutex_;
  std::map<const void*, Charge> charges_;  // by call. Lock: mutex_
};

}  // namespace choreo
