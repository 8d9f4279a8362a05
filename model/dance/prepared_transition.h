#pragma once

#include <chrono>
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

struct PreparedTransition {
  TransitionRequest request;
  std::string key_id;             ///< names its target in warnings
  std::vector<Warning> warnings;  ///< about its controls
};

/// Builds the request for one transition of a dance, without its stage and beats. `recurrence` is
/// that of the dance's music. `before` holds the poses danced or given before the transition; if
/// empty, it starts from ControlTrack::Stance. `audio` is null without music; rows before
/// `rows_end` must be ready, and the model gets no music from later rows.
PreparedTransition PrepareTransition(const DanceStart& start, const ModelInfo& model,
                                     const ControlTrack& controls, const Recurrence& recurrence,
                                     const AudioFeed* audio, const Segment& segment,
                                     int64_t rows_end, std::span<const Pose> before);

/// Adds a warning if the key is too far away for the time left.
void WarnOfSpeed(const ModelInfo& model, const TransitionRun& run, PreparedTransition* prepared);

}  // namespace choreo
