#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/dance/audio_feed.h"
#include "model/dance/control_track.h"
#include "model/dance/dance_config.h"
#include "model/dance/recurrence.h"
#include "model/dance/timeline.h"

namespace choreo {

/// The clock of SampleJob::Deadline, in seconds. It orders jobs and never changes a dance.
inline double PlaybackClock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Frames handed out before other dances get a turn.
inline constexpr int kFramesASlice = 16;

/// What a transition of a dance depends on.
struct TransitionInputs {
  const DanceStart& start;
  const ModelInfo& model;
  const ControlTrack& controls;
  const Recurrence& recurrence;  ///< of the dance's music
  const AudioFeed* audio;        ///< null without music
  const Segment& segment;
  int64_t rows_end;  ///< rows before it must be ready; the model gets no music from later ones
  /// The poses danced or given before the transition; empty: it starts from ControlTrack::Stance.
  std::span<const Pose> before;
  std::optional<GroundFrame> stage;  ///< TransitionSpec::stage
  std::vector<double> beats;         ///< TransitionSpec::beats
};

struct PreparedTransition {
  TransitionRequest request;
  std::string key_id;             ///< names its target in warnings
  std::vector<Warning> warnings;  ///< about its controls
};

/// Builds the request for one transition of a dance.
PreparedTransition PrepareTransition(const TransitionInputs& inputs);

/// Adds a warning if the key is too far away for the time left.
void WarnOfSpeed(const ModelInfo& model, const TransitionRun& run, PreparedTransition* prepared);

}  // namespace choreo
