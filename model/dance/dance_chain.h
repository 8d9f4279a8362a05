#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "model/core/error.h"
#include "model/dance/delivery/dance_reporter.h"
#include "model/dance/delivery/dance_sink.h"
#include "model/dance/delivery/delivery.h"
#include "model/dance/input/audio_feed.h"
#include "model/dance/requests/dance_start.h"
#include "model/dance/transition/dance_score.h"

namespace choreo {

/// The chain of transitions behind a DanceStream. Submits the score's transitions one after
/// another, each as soon as its start is known. Hands out frames once they are granted, their music
/// has arrived and the sink accepts them. Thread-safe.
class DanceChain : public Delivery<DanceSink> {
 public:
  /// The config must be valid.
  DanceChain(SampleQueue& queue, const ValidDance& config, std::shared_ptr<DanceSink> sink);

  /// Posts the events that precede the first message.
  void Begin(const ValidDance& config);

  /// Applies a message, posts its events to the sink, and continues the dance. If `change` throws,
  /// the exception propagates and the chain is unchanged. Does nothing once the dance is over.
  void Apply(const std::function<DanceEvents(DanceScore&)>& change);

  // DanceStream's functions of the same names call these.
  void PushAudio(std::span<const float> interleaved, int64_t first_sample);
  void EndOfAudio();
  void HalfClose();

 private:
  class Transition;

  /// Continues the dance after more music has arrived.
  void Continue() {
    Apply([](DanceScore&) { return DanceEvents(); });
  }
  AudioFeed& Audio(const char* field) {
    if (audio_ == nullptr) throw InvalidArgument(field, "comes in a dance without music");
    return *audio_;
  }
  void FinishAudio();  // requires pushing_
  // Posts a frame without the lock. `key`: the key that the frame reaches, if any.
  void PostFrame(const Transition& job, int64_t frame, const std::optional<Key>& key);

  double Seconds(int64_t frames) const { return static_cast<double>(frames) / model_.fps; }
  int64_t Ready() const { return audio_ ? audio_->ready() : 0; }

  // The functions below require mutex_. TakeNext returns a frame, the end of a transition, or the
  // end of the dance.
  std::function<void()> TakeNext() override;
  void Proceed() override;  // submits the next transition
  void Drop() override;
  double Due() const override { return start_time_ + Seconds(next_frame_ - first_frame_); }
  std::function<void()> FinishTransition();

  const DanceManner manner_;
  const uint64_t seed_;
  const int64_t first_frame_;
  std::mutex pushing_;                      // held while pushing music; locked before all others
  const std::unique_ptr<AudioFeed> audio_;  // null for a dance without music
  DanceReporter reporter_;                  // used by the thread that hands out

  // mutex_ guards the members below.
  double start_time_;  // start of playback, from which frames' deadlines count
  DanceScore score_;
  // The timeline's first transitions: the one being handed out, and the following ones. All but the
  // last have been sampled.
  std::deque<std::shared_ptr<Transition>> jobs_;
  DancedState danced_;  // state after the finished transitions
  int64_t next_frame_;  // the next frame to hand out
};

}  // namespace choreo
