#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/dance/dance_chain.h"

namespace choreo {

/// A dance in progress. It is a function of the config, the samples, and the order of these
/// messages: SetKey, RemoveKey, SetControls, GiveBeats, GivePassages, GenerateUntil, KeysComplete
/// and EndOfAudio. A new stream with the last continuation, the same config and the same messages,
/// except rejected ones, continues bit for bit. Its audio starts at ResumeSample. Frames after the
/// continuation are sent again.
///
/// A message that throws leaves the stream unchanged. Its error names a parameter, a member of one
/// ("key.pose.rotations[16]") or the function ("keys_complete"). Messages after the sink's last
/// call are ignored. Thread-safe. The destructor cancels the dance. The queue must outlive the
/// sink's last call and all jobs.
class DanceStream {
 public:
  /// `config`: must have been checked against the queue's model.
  DanceStream(SampleQueue& queue, const ValidDance& config, std::shared_ptr<DanceSink> sink)
      : chain_(std::make_shared<DanceChain>(queue, config, std::move(sink))) {
    chain_->Begin(config);
  }
  ~DanceStream() { Cancel(); }
  DanceStream(const DanceStream&) = delete;
  DanceStream& operator=(const DanceStream&) = delete;

  /// Adds interleaved samples. `first_sample` (absolute, in sample frames) must be the next one.
  /// Throws Error(kOutOfRange), naming the expected sample, for a gap or an overlap. Throws
  /// Error(kInvalidArgument) for bad samples, beyond kMaxAudioSeconds, and without
  /// DanceConfig::audio. Throws Error(kFailedPrecondition) after EndOfAudio.
  void PushAudio(std::span<const float> interleaved, int64_t first_sample) {
    chain_->PushAudio(interleaved, first_sample);
  }
  /// Ends the audio. Throws Error(kInvalidArgument) if there was no sample at all.
  void EndOfAudio() { chain_->EndOfAudio(); }
  /// Sets what is known about the whole music. Values in DanceConfig have precedence. If `music`
  /// has no beats, the dance detects none. Call before the first sample.
  void SetMusic(const MusicAnalysis& music) {
    chain_->Apply([&](DanceScore& score) { return score.SetMusic(music); });
  }
  /// Warns that the music's file is damaged or ends early. `notes`: DecodeMono's notes. `seconds`:
  /// the readable part's length.
  void NoteMusicDamaged(const std::vector<std::string>& notes, double seconds) {
    chain_->Apply([&](DanceScore& score) { return score.NoteMusicDamaged(notes, seconds); });
  }

  /// Sets a key (see Timeline). A key that comes too late causes a KeyRejected event, and is not
  /// set.
  void SetKey(const Key& key, const KeyMoment& when) {
    chain_->Apply([&](DanceScore& score) { return score.SetKey(key, when); });
  }
  /// Rejects an unusable key with a KeyRejected event, which names the field and the reason.
  void RejectKey(const std::string& id, const std::optional<KeyMoment>& when,
                 const std::string& field, const std::string& reason) {
    chain_->Apply([&](DanceScore& score) { return score.RejectKey(id, when, field, reason); });
  }
  void RemoveKey(const std::string& id) {
    chain_->Apply([&](DanceScore& score) { return score.RemoveKey(id); });
  }
  /// Sets controls (see ControlTrack) from the first frame that is not frozen. Not allowed after
  /// KeysComplete, which freezes all frames.
  void SetControls(const ControlRequest& request) {
    chain_->Apply([&](DanceScore& score) { return score.SetControls(request); });
  }
  /// Sets beats (see DanceMusic::GiveBeats), in seconds: at least one, checked by CheckBeats and
  /// CheckDownbeats. Beats in frozen frames are dropped with a Warning. Not allowed after
  /// KeysComplete.
  void GiveBeats(const std::vector<double>& seconds, const std::vector<double>& downbeats = {},
                 std::optional<double> confidence = {}) {
    chain_->Apply(
        [&](DanceScore& score) { return score.GiveBeats(seconds, downbeats, confidence); });
  }
  /// Sets passages: at least one, checked by CheckPassages. They replace known passages from the
  /// first of them on, for transitions that begin after the frozen frames. Not allowed after
  /// KeysComplete.
  void GivePassages(const std::vector<Passage>& passages) {
    chain_->Apply([&](DanceScore& score) { return score.GivePassages(passages); });
  }
  void GenerateUntil(int64_t frame) {
    chain_->Apply([&](DanceScore& score) { return score.GenerateUntil(frame); });
  }
  /// Ends the keys. Throws Error(kInvalidArgument) if the dance would have no end: no key, no
  /// music, no end_frame.
  void KeysComplete() { chain_->Apply(&DanceScore::KeysComplete); }

  /// Handles a client's half-close: does EndOfAudio and KeysComplete unless already done.
  void HalfClose() { chain_->HalfClose(); }

  /// Applies back-pressure: a paused stream hands out no frames, except one in progress. Never
  /// changes the dance.
  void SetPaused(bool paused) { chain_->SetPaused(paused); }

  /// Whether a transition is queued or being sampled.
  bool IsSampling() const { return chain_->IsSampling(); }

  /// Cancels the dance. The sink gets OnError(kCancelled) unless it has had its last call.
  /// Idempotent.
  void Cancel() noexcept { chain_->Cancel(); }

 private:
  const std::shared_ptr<DanceChain> chain_;
};

}  // namespace choreo
