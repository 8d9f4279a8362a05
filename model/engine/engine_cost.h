#pragma once

#include <mutex>

namespace choreo {

class StepEngine;

/// What an engine needs, as its warm-up measured it; seconds.
struct EngineCost {
  double admission = 0;  ///< of a transition, for each of its frames
  double alone = 0;      ///< a step of one slot; 0: nothing was measured
  double together = 0;   ///< a step of `slots` of them
  int slots = 1;         ///< at least 1
};

/// Dances short transitions in free slots of `engine`, alone and together, and forgets them:
/// whatever is set up when it is first used is there when the first client comes, and the engine's
/// cost() is known. Throws what the engine throws.
void WarmUp(StepEngine& engine);

/// What frames cost one engine: what its warm-up measured, corrected by what has been measured
/// since. A step of two slots is no two steps, so the cost of a frame follows from how many there
/// are. Thread-safe.
class FrameCost {
 public:
  /// `most` slots step together, at least 1.
  FrameCost(const EngineCost& measured, int most);

  /// A step of so many slots is done.
  void AddStep(int slots, double seconds);
  /// A transition is over: what its admission took, and how many of its frames were made.
  void AddTransition(double admission_seconds, int frames);

  /// The share of the engine's time that so many frames a second take of a model that runs at
  /// `fps`, above 1 where they are more than it can make. 0 without a warm-up: nothing is known.
  double LoadOf(double frames_per_second, double fps) const;

 private:
  double StepOf(double slots) const;  // as the warm-up measured it

  const EngineCost measured_;
  const int most_;
  mutable std::mutex mutex_;  // guards all below; sums in which what is old fades
  double steps_ = 0, expected_steps_ = 0;
  double admissions_ = 0, admitted_frames_ = 0;
};

}  // namespace choreo
