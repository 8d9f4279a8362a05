#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/dance/transition.h"
#include "model/engine/step_engine.h"

namespace choreo {

/// What a dance starts from. Everything else arrives as messages.
struct DanceConfig {
  uint64_t seed = 0;
  /// Which of the seed's dances. Candidate 0 is that of chained single transitions.
  uint32_t candidate = 0;
  std::optional<float> temperature;  ///< 0..2; none: the model's default
  std::string style;                 ///< one of the model's, or empty: any
  double output_fps = 30;            ///< 1..120; the model's own rate passes through untouched
  /// Up to tau poses before frame 0 (world, model rate, oldest first). None: the neutral stance
  /// where a root path begins at frame 0, or else at the origin; or the first key's pose if that
  /// stands on frame 0. Excludes `continuation`.
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
    /// The first sample frame that will be pushed, absolute. 0 for a fresh dance; one that begins
    /// in the middle may start later, at most at LatestFirstSample, and hears nothing before it.
    int64_t first_sample = 0;
  };
  std::optional<Audio> audio;  ///< none: the model dances without music
  /// As DanceStream::GenerateUntil, before all messages: keys then grant nothing.
  std::optional<int64_t> generate_until;
  /// Seconds, ascending: the dance is timed to them. None: to what it hears of the music.
  std::vector<double> music_beats;

  /// Where the dance starts: 0, or the continuation's frame.
  int64_t FirstFrame() const { return continuation ? continuation->frame : 0; }

  /// Throws Error(kInvalidArgument) with paths below "config"; Error(kFailedPrecondition) for a
  /// continuation of another fingerprint; Error(kOutOfRange) for audio that begins too late;
  /// Error(kUnimplemented) for music that the model can't hear.
  void Validate(const ModelInfo& model) const;
};

/// Last sample frame at which the audio of a dance, or transition, that starts at `first_frame` may
/// begin without changing a bit.
int64_t LatestFirstSample(int64_t first_frame, double sample_rate, const ModelInfo& model);

/// Where the audio of a dance that goes on from `first_frame` has to begin for all to be as if it
/// had not been interrupted: at LatestFirstSample, or, where the dance listens for beats, as far
/// back as these are heard in.
int64_t ResumeSample(const DanceConfig& config, int64_t first_frame, const ModelInfo& model);

/// Whether the model takes music.
bool TakesMusic(const ModelInfo& model);

/// Throws Error(kUnimplemented) if the model takes no music, Error(kInvalidArgument) for a format
/// out of range, Error(kOutOfRange) unless 0 <= first_sample <= LatestFirstSample. `field` is the
/// path of the audio.
void ValidateAudioStart(const ModelInfo& model, double sample_rate, int channels,
                        int64_t first_sample, int64_t first_frame, const std::string& field);

}  // namespace choreo
