#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/numbers/histogram.h"
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

  /// Computes the next slice with the worker's sampler, the same one for all slices. Returns true
  /// while more are left. An exception ends only this job, as a failure.
  virtual bool Continue(Sampler& sampler) = 0;

  /// The last call, made once: after the last slice (nullptr), after cancellation (kCancelled), or
  /// after a failure. If the job never began, any worker's thread makes it.
  virtual void OnDone(const Error* failure) noexcept = 0;

  /// When the first frame is due for playback, by PlaybackClock. Read once.
  virtual double Deadline() const = 0;
  /// The number of frames. 0 for a job that samples none, which statistics exclude.
  virtual int frames() const = 0;

  /// Whether to end the job. Read between slices from any thread, so it must be an atomic flag.
  virtual bool Cancelled() const = 0;
};

/// A queue of transitions for workers, each with a sampler and a thread. Between slices a worker
/// switches to the job that is due first, so neither many nor long transitions delay others. A job
/// stays with the worker that began it.
///
/// Real-time work precedes bulk work: bulk runs while no dance needs frames within `bulk_yields`. A
/// dance that is farther ahead of its playback yields to bulk.
///
/// Thread-safe; submitting never blocks. Holds a job until its OnDone has returned.
class SampleQueue {
 public:
  struct Options {
    int max_bulk = 128;  ///< bulk transitions that may be reserved at once, >= 0
    /// A dance's work precedes bulk from this long before it is due, >= 0. It equals a player's
    /// buffer, so bulk never interrupts playback, and is much longer than a slice or the
    /// preparation of a dance's music.
    std::chrono::milliseconds bulk_yields{1000};
  };
  struct Stats {
    int workers = 0;
    int active = 0;                        ///< jobs begun
    int waiting = 0;                       ///< jobs not yet begun
    uint64_t frames = 0, transitions = 0;  ///< completed
    /// A worker's consecutive failures that its jobs did not cause; the most of any worker.
    int failures = 0;
    double bulk_share = 0;   ///< the reserved share of max_bulk
    double cpu_seconds = 0;  ///< CPU time of the workers' threads in all slices
  };
  /// Measurements so far.
  struct Histograms {
    Histogram::Snapshot slice_s;       ///< seconds of a slice
    Histogram::Snapshot transition_s;  ///< seconds of a transition, summed over its slices
    /// For dances: seconds by which a transition was completed after its first frame was due or, if
    /// later, requested; 0 if in time.
    Histogram::Snapshot lateness_s;
  };
  /// Reserves capacity for bulk transitions while it exists. May outlive the queue.
  using Reservation = std::shared_ptr<void>;

  /// Starts one worker per sampler. Throws Error(kInvalidArgument) for options out of range,
  /// without samplers, and for samplers with different fingerprints, because a job's bits must not
  /// depend on which worker is free.
  SampleQueue(std::vector<std::unique_ptr<Sampler>> samplers, Options options);

  /// Stops, then joins the workers. Must not be called by a job.
  ~SampleQueue();

  /// Submits a dance's job. Throws Error(kUnavailable) after Stop, Error(kInvalidArgument) for a
  /// null job.
  void Submit(std::shared_ptr<SampleJob> job);

  /// Reserves capacity for bulk jobs. Throws Error(kResourceExhausted) if more than `max_bulk`
  /// would be reserved.
  Reservation ReserveBulk(int transitions);
  /// Submits a bulk job. Throws what Submit throws.
  void SubmitBulk(std::shared_ptr<SampleJob> job);

  /// Makes the workers check for cancelled jobs. Cheap; call on any thread.
  void CheckCancelled();

  /// Refuses new jobs, and ends queued ones with kUnavailable. Returns at once (see WaitUntilIdle).
  void Stop() noexcept;

  /// Waits until no job is left. Returns false on timeout. Must not be called by a job.
  bool WaitUntilIdle(std::chrono::milliseconds limit) const;

  const ModelInfo& model() const;
  std::vector<std::string> devices() const;
  Stats stats() const;
  /// The share of the workers' time that `frames_per_second` need at the recent cost of frames;
  /// above 1 if the workers are too slow. 0 without warm-up.
  double LoadOf(double frames_per_second) const;
  Histograms histograms() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo
