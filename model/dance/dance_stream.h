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

/// A dance in progress. It is a function of the config, the samples, and the order of the messages:
/// SetKey, RemoveKey, SetControls, GiveBeats, GivePassages, GenerateUntil, KeysComplete and
/// EndOfAudio. A new stream with the last continuation, the same config and the same messages,
/// except rejected ones, continues bit for bit. Its audio starts at ResumeSample, and frames after
/// that continuation are sent again.
///
/// A message that throws leaves the stream as it was; its error names the field by its path in the
/// API's message, such as "keyframe.pose.rotations[16]". Messages after the sink's last call are
/// ignored. Thread-safe. The destructor cancels. The queue must outlive the sink's last call and
/// all jobs.
class DanceStream {
 public:
  /// `config`: for the queue's model.
  DanceStream(SampleQueue& queue, const ValidDance& config, std::shared_ptr<DanceSink> sink)
      : chain_(std::make_shared<DanceChain>(queue, config, std::move(sink))) {
    chain_->Begin(config);
  }
  ~DanceStream() { Cancel(); }
  DanceStream(const DanceStream&) = delete;
  DanceStream& operator=(const DanceStream&) = delete;

  /// Interleaved samples; `first_sample` (absolute, counted in sample frames) must be the next one:
  /// Error(kOutOfRange) for a gap or an overlap, naming the sample expected.
  /// Error(kInvalidArgument) for bad samples, beyond kMaxAudioSeconds, without DanceConfig::audio.
  /// Error(kFailedPrecondition) after EndOfAudio.
  void PushAudio(std::span<const float> interleaved, int64_t first_sample) {
    chain_->PushAudio(interleaved, first_sample);
  }
  /// Throws Error(kInvalidArgument) if no sample came at all.
  void EndOfAudio() { chain_->EndOfAudio(); }
  /// Sets what is known about the whole music; DanceConfig has precedence. If it has no beats, the
  /// dance detects none. Call before the first sample.
  void SetMusic(const MusicAnalysis& music) {
    chain_->Apply([&](DanceScore& score) { return score.SetMusic(music); });
  }
  /// Warns that the music's file is damaged or ends early. `notes`: DecodeMono's; `seconds`: what
  /// could be read.
  void NoteMusicDamaged(const std::vector<std::string>& notes, double seconds) {
    chain_->Apply([&](DanceScore& score) { return score.NoteMusicDamaged(notes, seconds); });
  }

  /// Sets a key (see Timeline). A key that comes too late causes a KeyRejected event and changes
  /// nothing.
  void SetKey(const Key& key, const KeyMoment& when) {
    chain_->Apply([&](DanceScore& score) { return score.SetKey(key, when); });
  }
  /// Rejects a key that cannot be used: a KeyRejected event names the wrong field and says why.
  void RejectKey(const std::string& id, const std::optional<KeyMoment>& when,
                 const std::string& field, const std::string& reason) {
    chain_->Apply([&](DanceScore& score) { return score.RejectKey(id, when, field, reason); });
  }
  void RemoveKey(const std::string& id) {
    chain_->Apply([&](DanceScore& score) { return score.RemoveKey(id); });
  }
  /// Sets controls (see ControlTrack) from the first frame that is not frozen. None may come after
  /// KeysComplete, which freezes all.
  void SetControls(const ControlRequest& request) {
    chain_->Apply([&](DanceScore& score) { return score.SetControls(request); });
  }
  /// Gives beats, seconds, at least one, valid by CheckBeats and CheckDownbeats (see
  /// DanceMusic::GiveBeats). Those in frozen frames are dropped with a Warning. None may come after
  /// KeysComplete.
  void GiveBeats(const std::vector<double>& seconds, const std::vector<double>& downbeats = {},
                 std::optional<double> confidence = {}) {
    chain_->Apply(
        [&](DanceScore& score) { return score.GiveBeats(seconds, downbeats, confidence); });
  }
  /// Takes at least one passage, valid by CheckPassages. From the first on they replace known ones,
  /// for transitions that begin after the frozen frames. None may come after KeysComplete.
  void GivePassages(const std::vector<Passage>& passages) {
    chain_->Apply([&](DanceScore& score) { return score.GivePassages(passages); });
  }
  void GenerateUntil(int64_t frame) {
    chain_->Apply([&](DanceScore& score) { return score.GenerateUntil(frame); });
  }
  /// Throws Error(kInvalidArgument) if the dance then has no end: no key, no music, no end_frame.
  void KeysComplete() { chain_->Apply(&DanceScore::KeysComplete); }

  /// A client's half-close: EndOfAudio and KeysComplete, unless they have come already.
  void HalfClose() { chain_->HalfClose(); }

  /// Back-pressure: a paused stream hands out no frames, except one under way. Never changes the
  /// dance.
  void SetPaused(bool paused) { chain_->SetPaused(paused); }

  /// The sink gets OnError(kCancelled), unless its last call has come. Idempotent.
  void Cancel() noexcept { chain_->Cancel(); }

 private:
  const std::shared_ptr<DanceChain> chain_;
};

}  // namespace choreo
