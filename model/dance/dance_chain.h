#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "model/dance/audio_feed.h"
#include "model/dance/control_track.h"
#include "model/dance/dance_config.h"
#include "model/dance/dance_sink.h"
#include "model/dance/mailbox.h"
#include "model/dance/music_beats.h"
#include "model/dance/music_turn.h"
#include "model/dance/output_rate.h"
#include "model/dance/quality_meter.h"
#include "model/dance/recurrence.h"
#include "model/dance/timeline.h"
#include "model/dance/transition.h"
#include "model/engine/sample_queue.h"

namespace choreo {

/// What a dance's messages ask for so far.
struct DanceScore {
  DanceConfig config;
  Timeline timeline;
  ControlTrack controls;
  MusicBeats beats;
  Recurrence recurrence;
};

/// The state from which the next transition continues.
struct DancedState {
  std::vector<Pose> history = {};  ///< the last tau poses; empty: the dance begins without any
  std::optional<GroundFrame> stage = {};  ///< TransitionSpec::stage
};

/// The chain of transitions behind a DanceStream. It has the transitions of the score sampled
/// one after the other, each as soon as its start is known, and hands out frames once they are
/// granted, their music has come and the sink takes them. Thread-safe. Lock order: the chain's
/// before the queue's and the audio feed's; the sink is called without a lock. Its jobs keep it
/// alive.
class DanceChain : public std::enable_shared_from_this<DanceChain> {
 public:
  /// The config must be valid.
  DanceChain(SampleQueue& queue, const ValidDance& asked, std::shared_ptr<DanceSink> sink);

  /// Posts what the sink must know before the first message.
  void Begin();

  /// Applies a message and continues the dance from there. If `change` throws, the exception passes
  /// through and the chain stays as it was. Does nothing once the dance is over.
  void Apply(const std::function<void(DanceScore&)>& change);

  /// Tells the sink of an event; only inside Apply.
  void Post(const DanceEvent& event);

  /// Whether the last call to the sink has been made or is under way.
  bool over() const { return mailbox_.over(); }

  /// Answers a key with these hands that came too late: rejects it, or says that it was reached
  /// before the dance was resumed. Only inside Apply.
  void PostLate(const KeyRejected& rejection, std::optional<HandPose> hands);

  /// Null for a dance without music. Only one thread at a time may push.
  AudioFeed* audio() { return audio_.get(); }

  void SetPaused(bool paused);
  void Cancel() noexcept;

 private:
  class Job;

  // Like Apply, but for changes of the dance's own, and also after its end.
  void React(const std::function<void()>& change) noexcept;
  // Hands out at most `most` frames and ends of transitions, and calls the sink. Only one thread at
  // a time does so, on behalf of all others. Returns true if there may be more.
  bool HandOut(int most);

  double Seconds(int64_t frames) const { return static_cast<double>(frames) / model_.fps; }

  // The functions below require mutex_. Hands out a frame, or the end of a transition or of the
  // dance; false if nothing may go out now.
  bool HandOutNext();
  void SubmitNext();
  // Ends the transition that was submitted last where the music turns, as far as rows below `ready`
  // tell. Returns whether they tell all.
  bool TurnWithMusic(int64_t ready);
  void Submit(const Segment& segment, int64_t rows_end);
  bool IsOver(const Segment& segment) const;
  void Fail(Job& job, const Error& failure);
  void DropJobs();
  void PostContinuation();
  void Summarise();
  void Emit(const Job& job, const DanceFrame& frame);

  SampleQueue& queue_;
  const ModelInfo& model_;
  const int64_t first_frame_;
  std::atomic<bool> cancelled_ = false;
  std::atomic<bool> paused_ = false;
  Mailbox<DanceSink> mailbox_;
  const std::unique_ptr<AudioFeed> audio_;

  mutable std::mutex mutex_;  // guards the members below
  double start_time_;         // of the playback; frames are due relative to it
  DanceScore score_;
  // The first transitions of the timeline: the one being handed out, and the next. All but the last
  // are sampled.
  std::deque<std::shared_ptr<Job>> jobs_;
  std::optional<Error> failure_;  // why no transition can follow them
  DancedState danced_;            // by the transitions that are over
  int64_t next_frame_;            // the next to hand out
  bool handing_out_ = false, look_again_ = false;
  QualityMeter meter_;
  std::vector<KeyReached> reached_before_;  // the dance resumed, and not yet reported again
  OutputRate output_;
  MusicTurn turn_;  // watches the last of jobs_
};

}  // namespace choreo
