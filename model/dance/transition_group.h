#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/dance/dance_start.h"
#include "model/dance/quality_meter.h"
#include "model/dance/warning.h"
#include "model/engine/sample_queue.h"

namespace choreo {

/// The result of one candidate.
struct CandidateReport {
  int candidate = 0;
  QualityReport quality;  ///< its keys: one if there was a target
  Continuation continuation;
  /// How far it goes beyond what bodies can do (BodyWatch): the largest figure over its limit; 0 if
  /// it does not.
  double strain = 0;
};

/// Listens to a group. Calls come one at a time, from worker threads, with no lock held; they must
/// not block.
class GroupSink {
 public:
  virtual ~GroupSink() = default;
  virtual void OnFrames(int candidate, int64_t first_frame, std::span<const Pose> poses,
                        std::span<const Contacts> contacts) = 0;
  virtual void OnWarning(const Warning& warning) = 0;
  /// Last call: the candidates, best first.
  virtual void OnDone(std::span<const CandidateReport> ranked) = 0;
  /// Last call, instead of OnDone.
  virtual void OnError(const Error& error) = 0;
};

/// Sorts candidates, best first. kQuality compares the strain, then the steering
/// (KeyReached::correction_m, which includes a miss of the key; 0 without a target) in steps of 1
/// cm, then the share of frames without support in steps of 5 %, then the skate ratio in steps of 1
/// %, then the likelihood if the model has one, then the candidate's number. kLikelihood compares
/// the likelihood (which favours calm motion), then the number.
void RankCandidates(std::vector<CandidateReport>& candidates, RankBy by = RankBy::kQuality);

/// GenerateTransition: has the candidates of one transition sampled as bulk work, and hands out
/// their frames as the sink takes them. Candidate 0 is what DanceStream dances for the same
/// interval. The destructor cancels. Thread-safe. The queue must outlive it.
class TransitionGroup {
 public:
  /// `request`: for the queue's model. Throws Error(kResourceExhausted) if the queue has no room
  /// for all candidates (SampleQueue::ReserveBulk); the room is held until this and its jobs are
  /// gone.
  TransitionGroup(SampleQueue& queue, ValidGroup request, std::shared_ptr<GroupSink> sink);
  ~TransitionGroup();
  TransitionGroup(const TransitionGroup&) = delete;
  TransitionGroup& operator=(const TransitionGroup&) = delete;

  void SetPaused(bool paused);
  void Cancel() noexcept;

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace choreo
