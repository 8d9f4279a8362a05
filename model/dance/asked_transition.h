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

/// The clock of SampleJob::Deadline, seconds. It decides who goes first, never what is danced.
inline double PlaybackClock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Handed out before others have a turn.
inline constexpr int kFramesASlice = 16;

struct AskedTransition {
  TransitionRequest request;
  std::string key_id;             ///< what warnings call its target
  std::vector<Warning> warnings;  ///< of its controls
};

/// What a dance that starts so asks of one of its transitions, but for its stage and its beats.
/// `recurrence`: of its music.
/// `before`: what was danced or given before it; empty: ControlTrack::Stance. `audio`: null without
/// music; rows before `rows_end` must be ready, and a model that hears music hears those behind it
/// as none.
AskedTransition AskTransition(const DanceStart& start, const ModelInfo& model,
                              const ControlTrack& controls, const Recurrence& recurrence,
                              const AudioFeed* audio, const Segment& segment, int64_t rows_end,
                              std::span<const Pose> before);

/// A warning where the way to the key is too long for its time.
void WarnOfSpeed(const ModelInfo& model, const TransitionRun& run, AskedTransition* asked);

}  // namespace choreo
