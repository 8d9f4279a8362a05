#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/audio/music_analysis.h"
#include "model/dance/control_track.h"
#include "model/dance/dance_config.h"
#include "model/dance/dance_sink.h"
#include "model/dance/timeline.h"
#include "model/engine/sample_queue.h"

namespace choreo {

class AudioFeed;
class DanceChain;

/// A dance in progress. It is a function of the config, the samples, and the order of the messages:
/// SetKey, RemoveKey, SetControls, GiveBeats, GivePassages, GenerateUntil, KeysComplete and
/// EndOfAudio. A new stream with the last continuation, the same config and the same messages,
/// except rejected ones, continues bit for bit. Its audio starts at ResumeSample, and frames after
/// that continuation are sent again.
///
/// A message that throws leaves the stream as it was. Messages after the sink's last call are
/// ignored. Thread-safe. The destructor cancels. The queue must outlive the sink's last call and
/// all jobs.
class DanceStream {
 public:
  /// `config`: for the queue's model.
  DanceStream(SampleQueue& queue, const ValidDance& config, std::shared_ptr<DanceSink> sink);
  DanceStream(SampleQueue& queue, const DanceConfig& config, std::shared_ptr<DanceSink> sink)
      : DanceStream(queue, ValidDance(config, queue.model()), std::move(sink)) {}
  ~DanceStream();
  DanceStream(const DanceStream&) = delete;
  DanceStream& operator=(const DanceStream&) = delete;

  /// Interleaved samples; `first_sample` (absolute, counted in sample frames) must be the next one:
  /// Error(kOutOfRange) for a gap or an overlap, naming the sample expected.
  /// Error(kInvalidArgument) for bad samples, beyond kMaxAudioSeconds, without DanceConfig::audio.
  /// Error(kFailedPrecondition) after EndOfAudio.
  void PushAudio(std::span<const float> interleaved, int64_t first_sample);
  /// Throws Error(kInvalidArgument) if no sample came at all.
  void EndOfAudio();
  /// Sets what is known about the whole music; DanceConfig has precedence. If it has no beats, the
  /// dance detects none. Call before the first sample.
  void SetMusic(const MusicAnalysis& music);
  /// Warns that the music's file is damaged or ends early. `notes`: DecodeMono's; `seconds`: what
  /// could be read.
  void NoteMusicDamaged(const std::vector<std::string>& notes, double seconds);

  /// The next message of a kind, as errors name it: "keyframes[i]", where i counts accepted ones.
  std::string NextKeyframe() const;
  std::string NextControls() const;
  std::string NextMusicBeats() const;
  std::string NextMusicPassages() const;

  /// Sets a key (see Timeline). A key that comes too late causes a KeyRejected event and changes
  /// nothing. Errors name NextKeyframe().
  void SetKey(const Key& key, const KeyMoment& when);
  /// Rejects a key that cannot be used: a KeyRejected event names the wrong field and says why. It
  /// counts as a key accepted.
  void RejectKey(const std::string& id, const std::optional<KeyMoment>& when,
                 const std::string& field, const std::string& reason);
  void RemoveKey(const std::string& id);
  /// Sets controls (see ControlTrack) from the first frame that is not frozen. Errors name
  /// NextControls(); none may come after KeysComplete, which freezes all.
  void SetControls(const ControlRequest& request);
  /// Gives beats, seconds, at least one, valid by CheckBeats and CheckDownbeats (see
  /// MusicBeats::AddGiven). Those in frozen frames are dropped with a Warning. Errors name
  /// NextMusicBeats(); none may come after KeysComplete.
  void GiveBeats(const std::vector<double>& seconds, const std::vector<double>& downbeats = {},
                 std::optional<double> confidence = {});
  /// Takes at least one passage, valid by CheckPassages. From the first on they replace known ones,
  /// for transitions that begin after the frozen frames. Errors name NextMusicPassages(); none may
  /// come after KeysComplete.
  void GivePassages(const std::vector<Passage>& passages);
  void GenerateUntil(int64_t frame);
  /// Throws Error(kInvalidArgument) if the dance then has no end: no key, no music, no end_frame.
  void KeysComplete();

  /// A client's half-close: EndOfAudio and KeysComplete, unless they have come already.
  void HalfClose();

  /// Back-pressure: a paused stream hands out no frames, except one under way. Never changes the
  /// dance.
  void SetPaused(bool paused);

  /// The sink gets OnError(kCancelled), unless its last call has come. Idempotent.
  void Cancel() noexcept;

  /// How far frames lag behind the music, in output frames: the audio window, the resampling and,
  /// for a model that hears, one transition of the usual length (one to a key may be longer).
  static int LatencyFrames(const DanceStart& config, const ModelInfo& model);

 private:
  AudioFeed& Audio(const char* field);
  void FinishAudio();

  const ModelInfo& model_;
  const std::shared_ptr<DanceChain> chain_;
  std::mutex messages_;  // one message at a time; locked before the chain's
  // Accepted so far:
  std::atomic<int> keyframes_ = 0, removals_ = 0, controls_ = 0, beats_ = 0, passages_ = 0;
};

}  // namespace choreo
