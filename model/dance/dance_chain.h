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

/// The chain of transitions behind a DanceStream. Submits the score's transitions one after
/// another, each as soon as its start is known. Hands out frames once they are granted, their music
/// has arrived and the sink accepts them. Workers prepare and sample without the chain's lock;
/// reports and calls to the sink are also made without it. Thread-safe. Lock order: the chain's
/// lock before those of the queue and the audio feed. The chain's jobs keep it alive.
class DanceChain : public std::enable_shared_from_this<DanceChain> {
 public:
  /// The config must be valid.
  DanceChain(SampleQueue& queue, const ValidDance& config, std::shared_ptr<DanceSink> sink);

  /// Posts the events that precede the first message.
  void Begin(const ValidDance& config);

  /// Applies a message, posts its events to the sink, and continues the dance. If `change` throws,
  /// the exception propagates and the chain is unchanged. Does nothing once the dance is over.
  void Apply(const std::function<DanceEvents(DanceScore&)>& change);

  // The functions below implement those of DanceStream.
  void PushAudio(std::span<const float> interleaved, int64_t first_sample);
  void EndOfAudio();
  void HalfClose();
  void SetPaused(bool paused);
  void Cancel() noexcept;

  /// Hands out a few frames and ends of transitions, and calls the sink. One thread at a time does
  /// this on behalf of all. Returns true if there may be more.
  bool HandOut();

  // For HandOver.
  HandOver<DanceChain>& hand_over() { return hand_over_; }
  bool Cancelled() const { return cancelled_; }
  /// Called when a job that hands out frames has failed.
  void OnFailure(const Error& failure) noexcept;

 private:
  class Job;

  /// Continues the dance after more music has arrived.
  void Continue() {
    Apply([](DanceScore&) { return DanceEvents(); });
  }
  /// Whether the last call to the sink has been made or is being made.
  bool over() const { return mailbox_.over(); }
  AudioFeed& Audio(const char* field) {
    if (audio_ == nullptr) throw InvalidArgument(field, "comes without config.audio_format");
    return *audio_;
  }
  void FinishAudio();  // requires pushing_
  // Like Apply, for changes by the dance itself. Also works after its end.
  void React(const std::function<void()>& change) noexcept;
  // Hands out a few frames on this thread, which may be gRPC's; a worker hands out the rest.
  void HandOutHere();
  // Reports a frame without the lock. `key`: the key that the frame reaches, if any.
  void Report(const Job& job, int64_t frame, const std::optional<Key>& key);

  double Seconds(int64_t frames) const { return static_cast<double>(frames) / model_.fps; }
  int64_t Ready() const { return audio_ ? audio_->ready() : 0; }

  // The functions below require mutex_. Takes the next item to hand out: a frame, the end of a
  // transition, or the end of the dance. Returns a function that reports it, to be called without
  // the lock, or null if nothing may be handed out.
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
  std::mutex pushing_;                      // held while pushing music; locked before all others
  const std::unique_ptr<AudioFeed> audio_;  // null for a dance without music
  DanceReport report_;                      // used by the thread that hands out
  OutputRate output_;

  std::mutex mutex_;   // guards the members below
  double start_time_;  // start of playback, from which frames' deadlines count
  DanceScore score_;
  // The timeline's first transitions: the one being handed out, and the following ones. All but the
  // last have been sampled.
  std::deque<std::shared_ptr<Job>> jobs_;
  DancedState danced_;  // state after the finished transitions
  int64_t next_frame_;  // the next frame to hand out
  Pacer pacer_;         // paces handing out
  HandOver<DanceChain> hand_over_;
};

}  // namespace choreo
