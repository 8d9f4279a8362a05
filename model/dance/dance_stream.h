#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "model/dance/control_track.h"
#include "model/dance/dance_config.h"
#include "model/dance/dance_sink.h"
#include "model/dance/timeline.h"
#include "model/engine/sample_queue.h"

namespace choreo {

class AudioFeed;
class DanceChain;

/// A dance in progress. What is danced is a function of the config, of the order of SetKey,
/// RemoveKey, SetControls, GiveBeats, GenerateUntil and KeysComplete among themselves (see
/// Timeline), of the samples, and of where the music ends. A new stream with the last continuation
/// and the same config and messages (but those that were rejected) goes on bit for bit; audio
/// starts at ResumeSample, and frames behind that continuation come again.
///
/// A message that throws leaves the stream as it was; after the last callback it is ignored.
/// Thread-safe. Destruction cancels. The queue must outlive the last callback and all jobs.
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
  /// Error(kInvalidArgument) if no sample came at all.
  void EndOfAudio();
  /// What was found in the whole music before its first sample is pushed: beats (without any, the
  /// dance listens for none), passages, and the music's id. What DanceConfig states has precedence.
  void SetMusic(const std::vector<double>& beats, const std::vector<double>& downbeats,
                const std::vector<Passage>& passages, uint64_t music_id);

  /// The name of the next message of a kind in errors: "keyframes[i]", where i counts the accepted
  /// ones. For code that reads a message before handing it over.
  std::string NextKeyframe() const;
  std::string NextControls() const;
  std::string NextMusicBeats() const;
  std::string NextMusicPassages() const;

  /// See Timeline. A key too late is answered by a KeyRejected event. Errors name NextKeyframe().
  void SetKey(const std::string& id, const KeyMoment& when, const Pose& pose,
              const PoseMask& mask = {});
  void RemoveKey(const std::string& id);
  /// See ControlTrack. Holds from the first frame that is not frozen. Errors name NextControls();
  /// none may come after KeysComplete, which freezes all.
  void SetControls(const ControlRequest& request);
  /// Seconds, ascending, at least one: see MusicBeats::Give. Those in frozen frames are left out,
  /// and told of by a Warning. Errors name the times of NextMusicBeats(); none may come after
  /// KeysComplete.
  void GiveBeats(const std::vector<double>& seconds, const std::vector<double>& downbeats = {});
  /// As CheckPassages wants them, at least one: from the first of them on they hold in place of
  /// those that were known, for transitions that begin behind the frozen frames. Errors name those
  /// of NextMusicPassages(); none may come after KeysComplete.
  void GivePassages(const std::vector<Passage>& passages);
  void GenerateUntil(int64_t frame);
  /// Error(kInvalidArgument) if the dance then has no end: no key, no music, no end_frame.
  void KeysComplete();

  /// A client's half-close: EndOfAudio and KeysComplete, as far as they have not come.
  void HalfClose();

  /// Back-pressure: while paused no frame is handed out (one that is under way may still come).
  /// Never changes the dance.
  void SetPaused(bool paused);

  /// The sink gets OnError(kCancelled) unless it has had its last call. Idempotent.
  void Cancel() noexcept;

  /// By how many frames of output the dance lags behind the music: the audio window, the
  /// resampling, and, of a model that hears music, the usual transition, of which it hears all
  /// before it dances (one that leads to a key is as long as its way).
  static int LatencyFrames(const DanceStart& config, const ModelInfo& model);

 private:
  AudioFeed& Audio(const char* field);
  void FinishAudio();

  const ModelInfo& model_;
  std::shared_ptr<DanceChain> chain_;
  std::mutex messages_;  // they are taken one at a time; before the chain's lock
  // Taken so far:
  std::atomic<int> keyframes_ = 0, removals_ = 0, controls_ = 0, beats_ = 0, passages_ = 0;
};

}  // namespace choreo
