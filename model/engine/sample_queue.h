#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/histogram.h"
#include "model/plan/sampler.h"

namespace choreo {

/// The clock of SampleJob::Deadline, in seconds. It orders jobs and never changes a dance.
inline double PlaybackClock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A transition for the queue to sample. Continue and OnDone run on one worker's thread without a
/// lock of the queue, so they may call the queue; neither may block.
class SampleJob {
 public:
  virtual ~SampleJob() = default;

  /// Makes the next slice with the worker's sampler, always the same one. True while more are left.
  /// An exception ends only this job, as a failure.
  virtual bool Continue(Sampler& sampler) = 0;

  /// The last call, made once: after the last slice (nullptr), after cancellation (kCancelled), or
  /// after a failure. A job that never began ends on any worker's thread.
  virtual void OnDone(const Error* failure) noexcept = 0;

  /// When its first frame is due for its listener, by PlaybackClock. Read once.
  virtual double Deadline() const = 0;
  /// Its number of frames; 0 for a job that samples none, which statistics leave out.
  virtual int frames() const = 0;

  /// Read between slices from any thread (an atomic flag); true ends the job.
  virtual bool Cancelled() const = 0;
};

/// A queue of transitions for workers, each with a sampler and a thread. Between slices a worker
/// turns to the job that is due first, so neither crowds nor long transitions delay others. Jobs
/// stay with the worker that began them.
///
/// Real time precedes bulk: bulk is made while no dance needs anything within `bulk_yields`. A
/// dance that is farther ahead of its listener in turn yields to bulk.
///
/// Thread-safe; submitting never blocks. Holds a job until its OnDone has returned.
class SampleQueue {
 public:
  struct Options {
    int max_bulk = 128;  ///< bulk transitions that may be reserved at once, >= 0
    /// A dance's work precedes bulk from this long before it is due, >= 0: as much as a player has
    /// buffered, so that other calls never interrupt playback; far longer than a slice, or the
    /// preparation of a dance's music, takes.
    std::chrono::milliseconds bulk_yields{1000};
  };
  struct Stats {
    int workers = 0;
    int active = 0;                        ///< jobs begun
    int waiting = 0;                       ///< jobs not yet begun
    uint64_t frames = 0, transitions = 0;  ///< completed
    /// Consecutive failures of a worker's jobs that were not their fault; the largest of all
    /// workers.
    int failures = 0;
    double bulk_share = 0;   ///< of max_bulk, reserved
    double cpu_seconds = 0;  ///< of the workers' threads, in slices so far
  };
  /// Measurements so far.
  struct Histograms {
    Histogram::Snapshot slice_s;       ///< seconds of a slice
    Histogram::Snapshot transition_s;  ///< seconds of a transition, summed over its slices
    /// Seconds from when a dance's first frame was due, or was requested if later, to
    /// the completion of its transition; 0 if in time.
    Histogram::Snapshot lateness_s;
  };
  /// Capacity for bulk transitions until it is destroyed; may outlive the queue.
  using Reservation = std::shared_ptr<void>;

  /// One worker per sampler. Throws Error(kInvalidArgument) for options out of range, for no
  /// samplers, and for samplers with different fingerprints: a job's bits must not depend on which
  /// one is free.
  SampleQueue(std::vector<std::unique_ptr<Sampler>> samplers, Options options);

  /// Stops, then joins. Must not run inside a job's call.
  ~SampleQueue();

  /// Submits a dance's job. Throws Error(kUnavailable) after Stop, Error(kInvalidArgument) for a
  /// null job.
  void Submit(std::shared_ptr<SampleJob> job);

  /// Throws Error(kResourceExhausted) if more than `max_bulk` would be reserved.
  Reservation ReserveBulk(int transitions);
  /// Submits a bulk job. Throws what Submit throws.
  void SubmitBulk(std::shared_ptr<SampleJob> job);

  /// Looks for cancelled jobs. Cheap, from any thread.
  void CheckCancelled();

  /// Refuses new jobs; queued ones end now with kUnavailable. Returns at once (see WaitUntilIdle).
  void Stop() noexcept;

  /// Waits until no job is left; false on timeout. Must not run inside a job's call.
  bool WaitUntilIdle(std::chrono::milliseconds limit) const;

  const ModelInfo& model() const;
  std::vector<std::string> devices() const;
  Stats stats() const;
  /// The share of the workers' time that this many frames a second need, by the recent cost of
  /// frames; above 1 for more than they can make. 0 without warm-up.
  double LoadOf(double frames_per_second) const;
  Histograms histograms() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo
