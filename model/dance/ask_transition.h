#pragma once

#include <span>
#include <vector>

#include "model/dance/audio_feed.h"
#include "model/dance/control_track.h"
#include "model/dance/dance_config.h"
#include "model/dance/timeline.h"

namespace choreo {

struct AskedTransition {
  TransitionRequest request;
  std::vector<DanceWarning> warnings;  ///< of its controls
};

/// What a dance that starts so asks of one of its transitions, but for its stage and its beats.
/// `before`: what was danced or given before it; empty: ControlTrack::Stance. `audio`: null without
/// music; its rows before the transition must be ready.
AskedTransition AskTransition(const DanceStart& start, const ModelInfo& model,
                              const ControlTrack& controls, const AudioFeed* audio,
                              const Segment& segment, std::span<const Pose> before);

}  // namespace choreo
