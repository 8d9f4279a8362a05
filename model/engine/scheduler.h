#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/engine/step_engine.h"

namespace choreo {

/// One transition as the scheduler sees it. The scheduler calls every method from the worker thread that owns the job's slot, one
/// at a time; none may block. Implemented by dance/ (and by fakes in tests).
class StepJob {
 public:
  virtual ~StepJob() = default;
  virtual const TransitionSpec& spec() const = 0;
  /// The next frame's input but for `slot`; false while it can't be made yet (its audio has not arrived): the job then sleeps
  /// until Scheduler::Wake.
  virtual bool NextInput(StepInput* input) = 0;
  /// Takes the model's frame. Returns true while more frames are wanted.
  virtual bool OnFrame(const StepOutput& raw) = 0;
  /// Once, last: after the final frame (nullptr), after cancellation or when something failed.
  virtual void OnDone(const Error* failure) noexcept = 0;
  /// When this job's next frame is due on its listener's clock, seconds; earliest goes first when not all fit.
  virtual double NextDeadline() const = 0;
  /// Read before each step; a cancelled job frees its slot at once.
  virtual bool Cancelled() const = 0;
};

/// Feeds engines: one worker thread per engine; ready jobs step together; earliest deadline first; no added delay.
/// Thread-safe. Admission is bounded: Submit never blocks.
class Scheduler {
 public:
  struct Options {
    int max_waiting = 64;   ///< jobs beyond the engines' slots that may wait for one
    int max_batch = 64;     ///< most slots stepped at once
  };
  struct Stats {
    int active = 0, waiting = 0, slots = 0;
    uint64_t frames = 0, steps = 0;  ///< frames / steps = mean batch
  };

  Scheduler(std::vector<std::unique_ptr<StepEngine>> engines, Options options);
  ~Scheduler();  ///< Stop(), then joins

  /// Throws Error(kResourceExhausted) when full, Error(kUnavailable) after Stop.
  void Submit(std::shared_ptr<StepJob> job);
  /// The job may have become ready, or was cancelled. Cheap, from any thread, also for jobs already done.
  void Wake(const StepJob* job);
  /// No new jobs; jobs in progress run to their end (drain = true) or end as kUnavailable (false). Idempotent.
  void Stop(bool drain) noexcept;

  const ModelInfo& model() const;
  std::vector<std::string> devices() const;
  Stats stats() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo
