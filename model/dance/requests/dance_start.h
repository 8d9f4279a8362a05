#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/audio/music/music_analysis.h"
#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/core/valid.h"
#include "model/dance/controls/control_track.h"
#include "model/dance/timeline/spec_poses.h"
#include "model/dance/timeline/warning.h"
#include "model/messages/dance_manner.h"
#include "model/messages/quality_report.h"

namespace choreo {

/// The settings shared by a dance and a single transition: how to dance, and from where.
struct DanceStart : DanceManner, KnownMusic {
  uint64_t seed = 0;
  double output_fps = kModelFps;  ///< 1..120; frames at the model's own rate are not resampled
  /// Poses before the first frame (world, model rate, oldest first); only the last tau are used.
  /// Empty: the pose of a key on the first frame or, without one, the neutral stance, on the root
  /// path if it covers that frame, otherwise at the origin. Excludes `continuation`.
  std::vector<Pose> history;
  int64_t first_frame = 0;  ///< absolute, model rate; a continuation's frame has precedence
  std::optional<Continuation> continuation;  ///< where to resume
  /// Allows resuming from a continuation with another fingerprint, with a warning instead of
  /// Error(kFailedPrecondition).
  bool allow_inexact_resume = false;
  struct Audio {
    double sample_rate = 0;  ///< 8000..192000
    int channels = 0;        ///< 1..8, interleaved
    /// The first sample frame to be sent, absolute: at most LatestFirstSample, and 0 for a new
    /// dance. Earlier music is unknown to the dance.
    int64_t first_sample = 0;
  };
  std::optional<Audio> audio;  ///< none: the model dances without music

  /// The number of the first frame to generate.
  int64_t FirstFrame() const { return continuation ? continuation->frame : first_frame; }
  /// The poses before the first frame, from the continuation or the history.
  const std::vector<Pose>& Before() const { return continuation ? continuation->poses : history; }

  bool ResumesInexactly(const ModelInfo& model) const {
    return continuation && continuation->fingerprint != model.fingerprint;
  }
  /// Warnings to send before the first frame.
  std::vector<Warning> Warnings(const ModelInfo& model) const;
};

/// The configuration of a stream. Everything else arrives as messages.
struct DanceConfig : DanceStart {
  /// The end of the dance: its frames are [first, end_frame), model rate, absolute. Without it, a
  /// dance with music ends with the music or the last key, whichever is later, and one without
  /// music at the last key.
  std::optional<int64_t> end_frame;
  /// Acts like DanceStream::GenerateUntil before all messages. Keys then grant no frames.
  std::optional<int64_t> generate_until;
};

/// A GenerateTransition request: one transition with several ranked candidates.
struct GroupRequest : DanceStart {
  int candidates = 1;  ///< 1..kMaxCandidates, numbered from 0
  RankBy rank_by = RankBy::kQuality;
  int frames = 0;  ///< 1..min(kMaxTransitionFrames, the model's longest)
  std::optional<Target> target;
  std::string target_id = "target";  ///< the target's name in warnings and the report
  std::optional<Pose> after;
  std::optional<double> hit;  ///< TransitionSpec::hit
  ControlRequest controls;

  /// The music around the transition, from audio->first_sample on, interleaved. Silence follows it.
  std::vector<float> samples;
};

/// A config checked against its model.
class ValidDance : public Valid<DanceConfig> {
 public:
  /// Throws Error(kInvalidArgument) for invalid values, Error(kFailedPrecondition) for a
  /// continuation of another fingerprint, Error(kOutOfRange) for audio that begins too late, and
  /// Error(kUnimplemented) for music that the model cannot use. Errors name members: "history[0]",
  /// "before" for Before(). Keeps only the poses of the history that the model uses.
  ValidDance(DanceConfig request, const ModelInfo& model);
};

/// A single transition checked against its model.
class ValidGroup : public Valid<GroupRequest> {
 public:
  /// Throws what ValidDance throws, and the same for the other members: "target.rotations[3]".
  ValidGroup(GroupRequest group, const ModelInfo& model);

  /// Adds the music of a decoded file: mono samples, and what is known of them, unless the request
  /// says it.
  void SetMusic(std::vector<float> mono, MusicAnalysis music);
};

/// The last sample frame at which the audio of a dance or transition from `first_frame` may begin
/// without changing the result by a bit.
int64_t LatestFirstSample(int64_t first_frame, double sample_rate, const ModelInfo& model);

/// The sample at which the audio of a dance that continues from `first_frame` must begin, so that
/// the dance equals an uninterrupted one: LatestFirstSample, or an earlier one if the music's
/// energy or, with `beats`, the detection of beats looks further back. Never before the dance's
/// first sample. `dynamics`: DanceManner::Dynamics.
int64_t ResumeSample(const DanceStart::Audio& audio, double dynamics, int64_t first_frame,
                     const ModelInfo& model, bool beats);

/// How far frames lag behind the music, in output frames. Includes the audio window, resampling
/// and, for a model that hears, one transition of typical length (one to a key may be longer).
int LatencyFrames(const DanceStart& config, const ModelInfo& model);

}  // namespace choreo
