#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "model/dance/quality_report.h"
#include "model/dance/timeline.h"
#include "model/dance/transition.h"
#include "model/dance/warning.h"
#include "model/engine/scheduler.h"

namespace choreo {

/// What a dance starts from. Everything else arrives as messages.
struct DanceConfig {
  uint64_t seed = 0;
  uint32_t candidate =
      0;  ///< which of the seed's dances; candidate 0 is that of chained single transitions
  std::optional<float> temperature;  ///< 0..2; none: the model's default
  double output_fps = 30;            ///< 1..120; the model's own rate passes through untouched
  /// Up to tau poses before frame 0 (world, model rate, oldest first). None: the neutral stance at
  /// the origin, or the first key's pose if that stands on frame 0. Excludes `continuation`.
  std::vector<Pose> history;
  std::optional<Continuation> continuation;  ///< start at its frame
  /// Go on from a continuation of another fingerprint, with a warning, instead of
  /// Error(kFailedPrecondition).
  bool allow_inexact_resume = false;
  /// The dance is frames [first, end_frame), model rate, absolute. Without it a dance with music
  /// ends with the music or the last key, whichever is later, one without music at the last key.
  std::optional<int64_t> end_frame;

  struct Audio {
    double sample_rate = 0;  ///< 8000..192000
    int channels = 0;        ///< 1..8, interleaved
    /// The first sample frame that will be pushed, absolute. 0 for a fresh dance; one that goes on
    /// may start later, at most at DanceStream::LatestFirstSample.
    int64_t first_sample = 0;
  };
  std::optional<Audio> audio;       ///< none: the model dances without music
  std::vector<double> music_beats;  ///< seconds, ascending; for the report's beat figures alone

  /// Throws Error as DESIGN section 7 asks, with paths below "config".
  void Validate(const ModelInfo& model) const;
};

/// A key was reached, in the frames delivered just before.
struct KeyReached {
  std::string id;
  int64_t frame = 0;  ///< model rate
  double time = 0;    ///< seconds, of that frame
  ArrivalResult arrival;
};

using DanceEvent = std::variant<KeyReached, KeyRejection, DanceWarning>;

/// Listens to a dance. Calls come one at a time, in order, from a worker thread or from the thread
/// that sent a message, with no lock of the stream held: they may call the stream (SetPaused,
/// Cancel), and must not block. The last call is OnSummary or OnError, exactly once.
class DanceSink {
 public:
  virtual ~DanceSink() = default;
  /// Output rate; `first_frame` counts output frames from time 0. The spans live for the call.
  virtual void OnFrames(int64_t first_frame, std::span<const Pose> poses,
                        std::span<const std::array<float, 4>> contacts) = 0;
  virtual void OnEvent(const DanceEvent& event) = 0;
  /// At each transition's end, after its frames and events.
  virtual void OnContinuation(const Continuation& continuation) = 0;
  virtual void OnSummary(const QualityReport& report) = 0;
  /// kCancelled after Cancel; kResourceExhausted if the scheduler had no room; else what failed.
  virtual void OnError(const Error& error) = 0;
};

/// A dance in progress: a chain of transitions folded over messages. What is danced is a function
/// of the config and of the order of SetKey, RemoveKey, GenerateUntil and KeysComplete among
/// themselves (see Timeline), of the samples, and of where the music ends. It does not depend on
/// the clock, on how samples are cut into messages, on how audio and key messages interleave, or on
/// what else the scheduler does.
///
/// Resuming: a new stream with the last continuation, the same config and the same messages again
/// in the same order goes on bit for bit as the first would have. Keys before the continuation's
/// frame are answered by a rejection; audio may start at LatestFirstSample. Frames between that
/// continuation and the point where the first stream broke come again, equal.
///
/// A message that throws leaves the stream as it was; its sender decides whether to end the stream
/// by Cancel. After the last callback messages are ignored. Thread-safe; messages of one stream are
/// taken one at a time. Destruction cancels. The scheduler must outlive the stream's last callback.
class DanceStream {
 public:
  /// Throws as DanceConfig::Validate does.
  DanceStream(Scheduler& scheduler, const DanceConfig& config, std::shared_ptr<DanceSink> sink);
  ~DanceStream();
  DanceStream(const DanceStream&) = delete;
  DanceStream& operator=(const DanceStream&) = delete;

  /// Interleaved samples; `first_sample` (absolute, counted in sample frames) must be the next one:
  /// Error(kOutOfRange) for a gap or an overlap, naming the sample expected.
  /// Error(kInvalidArgument) for bad samples, beyond kMaxAudioSeconds, without config.audio.
  /// Error(kFailedPrecondition) after EndOfAudio.
  void PushAudio(std::span<const float> interleaved, int64_t first_sample);
  /// Error(kInvalidArgument) if no sample came at all.
  void EndOfAudio();
  /// In place of DanceConfig::music_beats, for who learns them later; until the last frame.
  void SetMusicBeats(std::vector<double> seconds);

  /// See Timeline. A key too late is answered by a KeyRejection event. Errors name "keyframes[i]",
  /// i counting the calls.
  void SetKey(const std::string& id, const KeyMoment& when, const Pose& pose,
              const PoseMask& mask = {});
  void RemoveKey(const std::string& id);
  void GenerateUntil(int64_t frame);
  /// Error(kInvalidArgument) if the dance then has no end: no key, no music, no end_frame.
  void KeysComplete();

  /// A client's half-close: EndOfAudio and KeysComplete, as far as they have not come.
  void HalfClose();

  /// Back-pressure: while paused no frame is made (one step that is under way may still deliver).
  /// Never changes the dance.
  void SetPaused(bool paused);

  /// Frees the slot; the sink gets OnError(kCancelled) unless it has had its last call. Idempotent.
  void Cancel() noexcept;

  /// By how many frames of output the dance lags behind the music: the audio window and the
  /// resampling.
  static int LatencyFrames(const DanceConfig& config, const ModelInfo& model);
  /// Last sample frame at which the audio of a dance that starts at `first_frame` may begin without
  /// changing a bit.
  static int64_t LatestFirstSample(int64_t first_frame, double sample_rate, const ModelInfo& model);

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace choreo
