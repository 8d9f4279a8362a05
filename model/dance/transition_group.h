#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/dance/dance_config.h"
#include "model/dance/quality_report.h"
#include "model/dance/warning.h"
#include "model/engine/sample_queue.h"

namespace choreo {

/// How one candidate came out.
struct CandidateReport {
  int candidate = 0;
  QualityReport quality;  ///< keys: one if there was a target
  Continuation continuation;
};

/// Listens to a group. Calls come one at a time, from worker threads, with no lock held; they must
/// not block.
class GroupSink {
 public:
  virtual ~GroupSink() = default;
  virtual void OnFrames(int candidate, int64_t first_frame, std::span<const Pose> poses,
                        std::span<const Contacts> contacts) = 0;
  virtual void OnWarning(const Warning& warning) = 0;
  /// Last: the candidates, best first.
  virtual void OnDone(std::span<const CandidateReport> ranked) = 0;
  /// Last, instead.
  virtual void OnError(const Error& error) = 0;
};

/// Best first. By quality: how far arrival steered it (KeyReached::correction_m, which a miss of
/// the key is part of) in steps of 1 cm, then the share of frames without support in steps of 5 %,
/// then skate ratio in steps of 1 %, then likelihood, of models that have one, then the candidate's
/// number. Without a target nothing is steered. By likelihood: that alone (it favours calm motion),
/// then the number.
void RankCandidates(std::vector<CandidateReport>& candidates, RankBy by = RankBy::kQuality);

/// GenerateTransition: has the candidates of one transition sampled, as bulk, and hands their
/// frames out as the sink takes them. Candidate 0 is what DanceStream dances for the same interval.
/// Destruction cancels. Thread-safe. The queue must outlive it.
class TransitionGroup {
 public:
  /// Throws as GroupRequest::Validate does, and Error(kResourceExhausted) if not all candidates
  /// find room (SampleQueue::ReserveBulk); they have it until all of this is gone.
  TransitionGroup(SampleQueue& queue, ValidTransition request, std::shared_ptr<GroupSink> sink);
  TransitionGroup(SampleQueue& queue, GroupRequest request, std::shared_ptr<GroupSink> sink)
      : TransitionGroup(queue, ValidTransition(std::move(request), queue.model()),
                        std::move(sink)) {}
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
