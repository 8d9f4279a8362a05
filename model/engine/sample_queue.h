#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/histogram.h"
#include "model/engine/sampler.h"

namespace choreo {

/// A transition to be made, as the queue sees it. Continue and OnDone come from one worker's
/// thread, with no lock of the queue held, so they may call it; neither may block.
class SampleJob {
 public:
  virtual ~SampleJob() = default;

  /// Makes its next slice with the worker's sampler, which is the same each time. True while more
  /// are left. What it throws ends this job alone, as a failure.
  virtual bool Continue(Sampler& sampler) = 0;

  /// Once, last: after the last slice (nullptr), after cancellation (kCancelled), or when something
  /// failed. A job that never began ends on any worker's thread.
  virtual void OnDone(const Error* failure) noexcept = 0;

  /// When its first frame is due on its listener's clock, seconds of std::steady_clock. Read once.
  virtual double Deadline() const = 0;
  /// How many frames it makes.
  virtual int frames() const = 0;

  /// Read between slices, from any thread at any time (an atomic flag): a cancelled job ends.
  virtual bool Cancelled() const = 0;
};

/// Transitions wait here for workers, each of which has a sampler and a thread. Between two slices
/// a worker goes over to whoever is due first, so neither a crowd nor a long transition holds up
/// those who dance. What a worker has begun stays with it.
///
/// Real time goes before bulk: bulk is made where no dance waits for anything that is due within
/// `bulk_yields`. A dance that is farther ahead of its listener yields to bulk in turn.
///
/// Thread-safe; submitting never blocks. A job is held until its OnDone has returned.
class SampleQueue {
 public:
  struct Options {
    int max_bulk = 128;  ///< transitions of bulk that may be reserved at once, >= 0
    /// For so long before it is due a dance's work goes before bulk, >= 0. As long as what a
    /// listener has in hand, so that no call of others is ever heard; far longer than a slice, or
    /// the music of a dance, takes.
    std::chrono::milliseconds bulk_yields{1000};
  };
  struct Stats {
    int workers = 0;
    int active = 0;                        ///< jobs that a worker has begun
    int waiting = 0;                       ///< jobs that none has begun
    uint64_t frames = 0, transitions = 0;  ///< made so far
    /// How often a worker's jobs have failed in a row for no fault of theirs; the largest of all.
    int failures = 0;
  };
  /// What it did so far.
  struct Histograms {
    Histogram::Snapshot slice_s;       ///< seconds of a slice
    Histogram::Snapshot transition_s;  ///< seconds of a transition, all of its slices
    /// Seconds by which a dance's transition was made after its first frame was due, or after it
    /// was asked for where that was later; 0 where it came in time.
    Histogram::Snapshot lateness_s;
  };
  /// Room for transitions of bulk, until it is destroyed; may outlive the queue.
  using Reservation = std::shared_ptr<void>;

  /// A worker for each sampler. Throws Error(kInvalidArgument) for options out of range, for no
  /// samplers, and for samplers whose fingerprints differ: a job's bits must not depend on which of
  /// them is free.
  SampleQueue(std::vector<std::unique_ptr<Sampler>> samplers, Options options);

  /// Stop, then joins. Not from inside a job's call.
  ~SampleQueue();

  /// A job of a dance. Throws Error(kUnavailable) after Stop, Error(kInvalidArgument) for a null
  /// job.
  void Submit(std::shared_ptr<SampleJob> job);

  /// Throws Error(kResourceExhausted) where more than `max_bulk` would be reserved.
  Reservation ReserveBulk(int transitions);
  /// A job of bulk. Throws as Submit does.
  void SubmitBulk(std::shared_ptr<SampleJob> job);

  /// Jobs may have been cancelled. Cheap, from any thread.
  void LookForCancelled();

  /// No new jobs; those in the queue end now, as kUnavailable. Returns at once (see WaitUntilIdle).
  void Stop() noexcept;

  /// Waits until no job is left; false if that took longer. Not from inside a job's call.
  bool WaitUntilIdle(std::chrono::milliseconds limit) const;

  const ModelInfo& model() const;
  std::vector<std::string> devices() const;
  Stats stats() const;
  /// The share of the workers' time that so many frames a second take, by what frames have cost
  /// lately; above 1 where they are more than can be made. 0 where no sampler was warmed up.
  double LoadOf(double frames_per_second) const;
  Histograms histograms() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo
