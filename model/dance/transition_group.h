#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/dance/delivery/quality_meter.h"
#include "model/dance/requests/dance_start.h"
#include "model/dance/timeline/warning.h"
#include "model/engine/sample_queue.h"

namespace choreo {

/// The result of one candidate.
struct CandidateReport {
  int candidate = 0;
  QualityReport quality;  ///< has one key if there was a target
  Continuation continuation;
  /// The excess over the limits of human bodies (BodyWatch): the largest ratio of a figure to its
  /// limit; 0 if no limit is exceeded.
  double strain = 0;
};

/// Receives a group's results. Its functions are called one at a time, from worker threads, without
/// any lock. They must not block.
class GroupSink {
 public:
  virtual ~GroupSink() = default;
  virtual void OnFrames(int candidate, int64_t first_frame, std::span<const Pose> poses,
                        std::span<const Contacts> contacts) = 0;
  virtual void OnWarning(const Warning& warning) = 0;
  /// The last call: the candidates, best first.
  virtual void OnDone(std::span<const CandidateReport> ranked) = 0;
  /// The last call, instead of OnDone.
  virtual void OnError(const Error& error) = 0;
};

/// Sorts candidates, best first. kQuality compares, in this order: strain; steering
/// (KeyReached::correction_m, which includes a miss of the key; 0 without a target) in steps of 1
/// cm; the share of frames without support in steps of 5 %; the skate ratio in steps of 1 %; the
/// likelihood, if the model has one; the candidate's number. kLikelihood compares the likelihood,
/// which favours calm motion, then the number.
void RankCandidates(std::vector<CandidateReport>& candidates, RankBy by = RankBy::kQuality);

/// Implements GenerateTransition. Samples the candidates of one transition as bulk work, and hands
/// out their frames as fast as the sink accepts them. Candidate 0 equals DanceStream's dance for
/// the same interval. The destructor cancels. Thread-safe. The queue must outlive this object.
class TransitionGroup {
 public:
  /// `request`: must have been checked against the queue's model. Throws Error(kResourceExhausted)
  /// if the queue has no room for all candidates (SampleQueue::ReserveBulk). The room is reserved
  /// until this object and its jobs are destroyed.
  TransitionGroup(SampleQueue& queue, ValidGroup request, std::shared_ptr<GroupSink> sink);
  ~TransitionGroup();
  TransitionGroup(const TransitionGroup&) = delete;
  TransitionGroup& operator=(const TransitionGroup&) = delete;

  void SetPaused(bool paused);
  bool IsSampling() const;  ///< whether a candidate is queued or being sampled
  void Cancel() noexcept;

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace choreo
