#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "model/core/error.h"
#include "model/dance/audio_feed.h"
#include "model/dance/dance_report.h"
#include "model/dance/dance_score.h"
#include "model/dance/dance_sink.h"
#include "model/dance/dance_start.h"
#include "model/dance/mailbox.h"
#include "model/dance/output_rate.h"
#include "model/dance/pacer.h"
#include "model/engine/sample_queue.h"

namespace choreo {

/// The chain of transitions behind a DanceStream. It submits the score's transitions one after the
/// other, each as soon as its start is known. It hands out frames once they are granted, their
/// music has come and the sink takes them. Workers prepare and sample without its lock, and reports
/// and the sink's calls are made without it. Thread-safe. Lock order: the chain's before the
/// queue's and the audio feed's. Its jobs keep it alive.
class DanceChain : public std::enable_shared_from_this<DanceChain> {
 public:
  /// The config must be valid.
  DanceChain(SampleQueue& queue, const ValidDance& config, std::shared_ptr<DanceSink> sink);

  /// Posts what the sink must know before the first message.
  void Begin(const ValidDance& config);

  /// Applies a message, tells the sink of the events that it causes, and continues the dance from
  /// there. If `change` throws, the exception passes through and the chain stays as it was. Does
  /// nothing once the dance is over.
  void Apply(const std::function<DanceEvents(DanceScore&)>& change);

  // As in DanceStream.
  void PushAudio(std::span<const float> interleaved, int64_t first_sample);
  void EndOfAudio();
  void HalfClose();
  void SetPaused(bool paused);
  void Cancel() noexcept;

  /// Hands out a few frames and ends of transitions, and calls the sink. One thread at a time does
  /// so for all others. True if there may be more.
  bool HandOut();

  // For HandOver.
  HandOver<DanceChain>& hand_over() { return hand_over_; }
  bool Cancelled() const { return cancelled_; }
  /// A job that hands out has failed.
  void OnFailure(const Error& failure) noexcept;

 private:
  class Job;

  /// Continues the dance because there is more music.
  void Continue() {
    Apply([](DanceScore&) { return DanceEvents(); });
  }
  /// Whether the last call to the sink has been made or is under way.
  bool over() const { return mailbox_.over(); }
  AudioFeed& Audio(const char* field) {
    if (audio_ == nullptr) throw InvalidArgument(field, "comes without config.audio_format");
    return *audio_;
  }
  void FinishAudio();  // requires pushing_
  // Like Apply, for the dance's own changes; also after its end.
  void React(const std::function<void()>& change) noexcept;
  // Hands out a few frames on this thread, which may be gRPC's; a worker hands out the rest.
  void HandOutHere();
  // Reports a frame without the lock; `key` is set if the frame reaches it.
  void Report(const Job& job, int64_t frame, const std::optional<Key>& key);

  double Seconds(int64_t frames) const { return static_cast<double>(frames) / model_.fps; }
  int64_t Ready() const { return audio_ ? audio_->ready() : 0; }

  // The functions below require mutex_.
  // Takes what goes out next: a frame, the end of a transition, or that of the dance. Returns the
  // function that reports it, to be called without the lock; null if nothing may go out.
  std::function<void()> TakeNext();
  std::function<void()> FinishTransition();
  void SubmitNext();
  void DropJobs();

  SampleQueue& queue_;
  const ModelInfo& model_;
  const DanceManner manner_;
  const uint64_t seed_;
  const int64_t first_frame_;
  std::atomic<bool> cancelled_ = false;
  std::atomic<bool> paused_ = false;
  Mailbox<DanceSink> mailbox_;
  std::mutex pushing_;                      // of whoever pushes music; before all other locks
  const std::unique_ptr<AudioFeed> audio_;  // null for a dance without music
  DanceReport report_;                      // of the thread that hands out, as is output_
  OutputRate output_;

  std::mutex mutex_;   // guards the members below
  double start_time_;  // of the playback; frames are due relative to it
  DanceScore score_;
  // The first transitions of the timeline: the one being handed out, and the next. All but the last
  // are sampled.
  std::deque<std::shared_ptr<Job>> jobs_;
  DancedState danced_;  // by the transitions that are over
  int64_t next_frame_;  // the next to hand out
  Pacer pacer_;         // of what is handed out
  HandOver<DanceChain> hand_over_;
};

}  // namespace choreo
