#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/histogram.h"
#include "model/engine/step_engine.h"

namespace choreo {

/// One transition as the scheduler sees it. Calls come from a worker thread, one at a time, with no
/// lock of the scheduler held, so they may call it; none may block. A job that sleeps can lose its
/// slot and be run again from its first frame later (OnRestart): its bits are the same. What spec,
/// NextInput or OnFrame throw ends this job alone, as a failure.
class StepJob {
 public:
  virtual ~StepJob() = default;

  /// Read once, when its admission begins.
  virtual const TransitionSpec& spec() const = 0;

  /// The next frame's input but for `slot`; false while it can't be made yet (its audio has not
  /// arrived): the job then sleeps until Scheduler::Wake. After true the step follows at once; what
  /// the input points to must live until OnFrame or OnDone.
  virtual bool NextInput(StepInput* input) = 0;

  /// Whether NextInput would give an input now. May be called from any worker thread at any time,
  /// so it must be thread-safe; after OnDone the answer counts no more.
  virtual bool Ready() const = 0;

  /// The slot went to another job while this one slept. Now it has one again and begins anew: frame
  /// 0 is the next that is asked for, and all that it has taken come again.
  virtual void OnRestart() = 0;

  /// Takes the model's frame. Returns true while more frames are wanted.
  virtual bool OnFrame(const StepOutput& raw) = 0;

  /// Once, last: after the final frame (nullptr), after cancellation (kCancelled), or when
  /// something failed. The job's slot is free by then, and the first job that Submit takes from
  /// inside OnDone inherits it, unless one that waits is due earlier. (A job that ends while it has
  /// no slot leaves none.)
  virtual void OnDone(const Error* failure) noexcept = 0;

  /// When this job's next frame is due on its listener's clock, seconds of std::steady_clock;
  /// earliest goes first when not all fit into one step, or into the slots.
  virtual double NextDeadline() const = 0;

  /// Read before each step and each slice of an admission; a cancelled job frees its slot at once.
  /// May be called from any worker thread at any time, so it must be thread-safe (an atomic flag).
  virtual bool Cancelled() const = 0;
};

/// Feeds engines, one worker thread each: ready jobs step together, earliest deadline first, and
/// between two steps comes a slice of an admission, theirs who is due first, so that neither a
/// crowd nor a long transition stops those who dance. Who waits is given a slot when one is left,
/// or when somebody who has one has slept for `max_sleep`. Jobs of dances are never refused for
/// want of room. Jobs of groups hold half of the slots at most (at least one).
///
/// Real time goes before bulk: what groups want is made where no dance wants anything that is due
/// within `bulk_yields`. A dance that is farther ahead of its listener yields to them in turn.
///
/// Thread-safe; submitting never blocks. A job is held until its OnDone has returned.
class Scheduler {
 public:
  struct Options {
    int max_waiting = 64;  ///< jobs of groups beyond their slots that may wait for one, >= 0
    /// Most slots of one engine stepped at once, >= 1; its batch() at most.
    int max_batch = kMostSlots;
    /// Most slices of admissions that one engine makes between two steps, >= 1, earliest deadlines
    /// first.
    int max_admissions = 1;
    /// For so long before it is due a dance's work goes before that of groups, >= 0. As long as
    /// what a listener has in hand, so that no call of others is ever heard; far longer than a
    /// slice, or the music of a dance, takes.
    std::chrono::milliseconds bulk_yields{1000};
    /// How long a job that sleeps keeps its slot while others wait for one, >= 0.
    std::chrono::milliseconds max_sleep{500};
  };
  struct Stats {
    int active = 0;   ///< jobs that hold a slot
    int asleep = 0;   ///< of those, jobs that can make no frame now
    int waiting = 0;  ///< jobs that wait for one
    int parked = 0;   ///< jobs that lost theirs while they slept, and sleep on
    int slots = 0;    ///< of all engines
    uint64_t frames = 0;
    uint64_t steps = 0;  ///< frames / steps = mean batch
    /// How often an engine has failed in a row, be it a step or an admission; the largest of all.
    int failures = 0;
  };
  /// What it did so far, one value a step, an admission, or a frame.
  struct Histograms {
    Histogram::Snapshot batch;        ///< frames of a step
    Histogram::Snapshot step_s;       ///< seconds of a step
    Histogram::Snapshot admission_s;  ///< seconds of an admission, all of its slices
    /// Seconds that a frame of a dance came after it was due, or after it could be made where that
    /// was later; 0 where it came in time. Waiting for a slot and for admission counts.
    Histogram::Snapshot lateness_s;
  };

  /// Throws Error(kInvalidArgument) for options out of range, for no engines, and for engines whose
  /// fingerprints differ: a job's bits must not depend on which of them is free.
  Scheduler(std::vector<std::unique_ptr<StepEngine>> engines, Options options);

  /// Stop(false), then joins. Not from inside a job's call.
  ~Scheduler();

  /// A job of a dance. Throws Error(kUnavailable) after Stop, Error(kInvalidArgument) for a null
  /// job and for one that is submitted already and not yet done.
  void Submit(std::shared_ptr<StepJob> job);

  /// Jobs that come together: all are taken, or none. Throws as Submit does, and
  /// Error(kResourceExhausted) where more than `max_waiting` would wait.
  void SubmitGroup(std::vector<std::shared_ptr<StepJob>> jobs);

  /// The job may have become ready, or was cancelled. Cheap, from any thread. `job` is compared and
  /// never read: it may be done, destroyed, or not yet submitted. A call too many does no harm.
  void Wake(const StepJob* job);

  /// No new jobs. drain = true: accepted jobs run to their end, also those that wait, and so do the
  /// jobs that inherit their slots; false: all end now, as kUnavailable. Returns at once (see
  /// WaitUntilIdle); may be called again, and then only from true to false changes anything.
  void Stop(bool drain) noexcept;

  /// Waits until no job is active or waiting; false if that took longer. Not from inside a job's
  /// call.
  bool WaitUntilIdle(std::chrono::milliseconds limit) const;

  const ModelInfo& model() const;
  std::vector<std::string> devices() const;
  Stats stats() const;
  /// The share of the engines' time that so many frames a second take, by what frames have cost
  /// lately; above 1 where they are more than the engines can make. 0 where no engine was warmed
  /// up.
  double LoadOf(double frames_per_second) const;
  Histograms histograms() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo
