#include "model/dance/ask_transition.h"

namespace choreo {

AskedTransition AskTransition(const DanceStart& start, const ModelInfo& model,
                              const ControlTrack& controls, const AudioFeed* audio,
                              const Segment& segment, std::span<const Pose> before) {
  AskedTransition asked;
  TransitionRequest& request = asked.request;
  request.frames = static_cast<int>(segment.to - segment.from);
  request.first_frame = segment.from;
  if (segment.key) request.target = Target{segment.key->pose, segment.key->mask};
  Pose stance;
  if (before.empty()) {
    stance = controls.Stance(segment.from, request.frames == 1 ? request.target : std::nullopt);
    before = {&stance, 1};
  }
  request.history = FillHistory(model, before);
  if (audio != nullptr) {
    request.has_audio = true;
    request.audio_history = audio->History(segment.from, model.history_frames);
  }
  request.seed = start.seed;
  request.style = start.style;
  request.temperature = start.temperature.value_or(static_cast<float>(model.default_temperature));
  controls.Ask(segment.key ? segment.key->id : "", &request, &asked.warnings);
  return asked;
}

}  // namespace choreo
