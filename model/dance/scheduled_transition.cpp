#include "model/dance/scheduled_transition.h"

#include <utility>

namespace choreo {

AskedTransition AskTransition(const DanceStart& start, const ModelInfo& model,
                              const ControlTrack& controls, const AudioFeed* audio,
                              const Segment& segment, std::span<const Pose> before) {
  AskedTransition asked;
  TransitionRequest& request = asked.request;
  request.frames = static_cast<int>(segment.to - segment.from);
  request.first_frame = segment.from;
  if (segment.key) {
    request.target = Target{segment.key->pose, segment.key->mask};
    asked.key_id = segment.key->id;
  }
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
  controls.Ask(asked.key_id, &request, &asked.warnings);
  return asked;
}

ScheduledTransition::ScheduledTransition(const ModelInfo& model, AskedTransition asked,
                                         const AudioFeed* audio, double start_time, Begins begins)
    : model_(model),
      request_(std::move(asked.request)),
      warnings_(std::move(asked.warnings)),
      audio_(audio),
      start_time_(start_time),
      row_(static_cast<size_t>(model_.audio_features)) {
  if (begins == Begins::kLate) return;
  run_.emplace(model_, request_);
  const std::optional<RequiredSpeed> speed = run_->required_speed();
  if (speed && speed->TooFast()) {
    warnings_.push_back(IntervalTooShort(model_.skeleton, asked.key_id, request_.first_frame,
                                         request_.frames, *speed));
  }
}

}  // namespace choreo
