#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/core/valid.h"
#include "model/dance/control_track.h"
#include "model/dance/spec_poses.h"
#include "model/dance/warning.h"
#include "model/messages/dance_manner.h"
#include "model/messages/quality_report.h"

namespace choreo {

/// What a dance and a single transition share: how to dance, and from where.
struct DanceStart : DanceManner, KnownMusic {
  uint64_t seed = 0;
  double output_fps = kModelFps;  ///< 1..120; the model's own rate passes through untouched
  /// Poses before the first frame (world, model rate, oldest first), of which the last tau count.
  /// None: the neutral stance where a root path begins at that frame, or else at the origin; or the
  /// first key's pose if that stands on it. Excludes `continuation`.
  std::vector<Pose> history;
  int64_t first_frame = 0;  ///< absolute, model rate; a continuation's frame goes before it
  std::optional<Continuation> continuation;  ///< start at its frame
  /// Resume from a continuation of another fingerprint with a warning instead of
  /// Error(kFailedPrecondition).
  bool allow_inexact_resume = false;
  struct Audio {
    double sample_rate = 0;  ///< 8000..192000
    int channels = 0;        ///< 1..8, interleaved
    /// The first sample frame to be sent, absolute: at most LatestFirstSample, and 0 for a new
    /// dance. Earlier music is ignored.
    int64_t first_sample = 0;
  };
  std::optional<Audio> audio;  ///< none: the model dances without music

  /// Number of the first frame to be made.
  int64_t FirstFrame() const { return continuation ? continuation->frame : first_frame; }
  /// The poses before it, from the continuation or the history.
  const std::vector<Pose>& Before() const { return continuation ? continuation->poses : history; }

  bool ResumesInexactly(const ModelInfo& model) const {
    return continuation && continuation->fingerprint != model.fingerprint;
  }
  /// Warnings to send before the first frame.
  std::vector<Warning> Warnings(const ModelInfo& model) const;
};

/// The start of a stream. Everything else arrives as messages.
struct DanceConfig : DanceStart {
  /// The dance is frames [first, end_frame), model rate, absolute. Without it a dance with music
  /// ends with the music or the last key, whichever is later, one without music at the last key.
  std::optional<int64_t> end_frame;
  /// Acts like DanceStream::GenerateUntil before all messages: keys then grant nothing.
  std::optional<int64_t> generate_until;
};

/// GenerateTransition: one transition, several candidates of it, ranked.
struct GroupRequest : DanceStart {
  int candidates = 1;  ///< 1..kMaxCandidates, numbered from 0
  RankBy rank_by = RankBy::kQuality;
  int frames = 0;  ///< 1..min(kMaxTransitionFrames, the model's longest)
  std::optional<Target> target;
  std::string target_id = "target";  ///< its name in warnings and the report
  std::optional<Pose> after;
  std::optional<double> hit;  ///< TransitionSpec::hit
  ControlRequest controls;

  /// The music around the transition, from audio->first_sample on, interleaved; beyond its end is
  /// silence.
  std::vector<float> samples;
};

/// A config that its model can dance.
class ValidDance : public Valid<DanceConfig> {
 public:
  /// Throws Error(kInvalidArgument); Error(kFailedPrecondition) for a continuation of another
  /// fingerprint; Error(kOutOfRange) for audio that begins too late; Error(kUnimplemented) for
  /// music that the model cannot take. Fields are named as the API names them:
  /// "config.history.poses[0]".
  ValidDance(DanceConfig request, const ModelInfo& model);
};

/// A single transition that its model can dance.
class ValidGroup : public Valid<GroupRequest> {
 public:
  /// Throws what ValidDance throws, with fields of the request, too: "target.rotations[3]".
  ValidGroup(GroupRequest group, const ModelInfo& model);
};

/// Last sample frame at which the audio of a dance, or transition, that starts at `first_frame` may
/// begin without changing a bit.
int64_t LatestFirstSample(int64_t first_frame, double sample_rate, const ModelInfo& model);

/// The sample where the audio of a dance that continues from `first_frame` must begin, so that the
/// dance equals an uninterrupted one: at LatestFirstSample, or earlier if the music's energy, or
/// the detection of `beats`, looks further back; but never before the dance's own first sample.
int64_t ResumeSample(const DanceStart& start, int64_t first_frame, const ModelInfo& model,
                     bool beats);

/// How far frames lag behind the music, in output frames: the audio window, the resampling and,
/// for a model that hears, one transition of the usual length (one to a key may be longer).
int LatencyFrames(const DanceStart& config, const ModelInfo& model);

}  // namespace choreo
