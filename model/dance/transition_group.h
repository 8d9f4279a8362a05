#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/dance/dance_config.h"
#include "model/dance/quality_report.h"
#include "model/dance/transition.h"
#include "model/dance/warning.h"
#include "model/engine/scheduler.h"

namespace choreo {

/// GenerateTransition: one transition, several candidates of it, ranked.
struct GroupRequest {
  uint64_t seed = 0;
  int candidates = 1;                ///< 1..32, numbered from 0
  std::optional<float> temperature;  ///< 0..2; none: the model's default
  double output_fps = 30;
  int frames = 0;             ///< 1..min(1800, the model's longest)
  std::vector<Pose> history;  ///< as TransitionRequest's; excludes `continuation`
  std::optional<Continuation> continuation;
  bool allow_inexact_resume = false;
  int64_t first_frame = 0;  ///< absolute, model rate; a continuation's frame goes before it
  std::optional<WorldTarget> target;
  std::optional<Pose> after;

  /// The music around the transition, whole: samples from `first_sample` (absolute) on. It must
  /// begin no later than LatestFirstSample; beyond its end is silence. Empty samples
  /// with a rate of 0: no music.
  double sample_rate = 0;
  int channels = 0;
  int64_t first_sample = 0;
  std::vector<float> samples;
  std::vector<double> music_beats;  ///< seconds, for the report alone

  /// Throws Error with paths of the request: "frames", "target.rotations[3]", "history[0]",
  /// "audio.sample_rate", ...
  void Validate(const ModelInfo& model) const;
};

/// How one candidate came out.
struct CandidateReport {
  int candidate = 0;
  QualityReport quality;  ///< keys: one, with id "target", if there was a target
  Continuation continuation;
};

/// Listens to a group. Calls come one at a time, from worker threads, with no lock held; they must
/// not block.
class GroupSink {
 public:
  virtual ~GroupSink() = default;
  virtual void OnFrames(int candidate, int64_t first_frame, std::span<const Pose> poses,
                        std::span<const std::array<float, 4>> contacts) = 0;
  virtual void OnWarning(const DanceWarning& warning) = 0;
  /// Last: the candidates, best first.
  virtual void OnDone(std::span<const CandidateReport> ranked) = 0;
  /// Last, instead.
  virtual void OnError(const Error& error) = 0;
};

/// Best first: raw key error in steps of 1 cm, then skate ratio in steps of 1 %, then likelihood
/// (which alone would favour frozen motion), then the candidate's number. Without a target the key
/// error is 0.
void RankCandidates(std::vector<CandidateReport>& candidates);

/// Runs the candidates of one transition through the scheduler, which steps them together as slots
/// allow. Candidate 0 is what DanceStream dances for the same interval. Destruction cancels.
/// Thread-safe.
class TransitionGroup {
 public:
  /// Throws as GroupRequest::Validate does, and Error(kResourceExhausted) if not all candidates
  /// find room.
  TransitionGroup(Scheduler& scheduler, const GroupRequest& request,
                  std::shared_ptr<GroupSink> sink);
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
