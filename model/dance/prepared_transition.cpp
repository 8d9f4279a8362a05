#include "model/dance/prepared_transition.h"

#include <utility>

namespace choreo {
namespace {

// The energy of the music before a frame.
double HearEnergyAt(const AudioFeed& audio, const DanceStart& start, int64_t frame) {
  return start.music_dynamics * HearEnergy(audio.Sounds(frame, kDynamicsMemory));
}

}  // namespace

PreparedTransition PrepareTransition(const DanceStart& start, const ModelInfo& model,
                                     const ControlTrack& controls, const Recurrence& recurrence,
                                     const AudioFeed* audio, const Segment& segment,
                                     int64_t rows_end, std::span<const Pose> before) {
  PreparedTransition prepared;
  TransitionRequest& request = prepared.request;
  request.frames = static_cast<int>(segment.to - segment.from);
  request.first_frame = segment.from;
  if (segment.key) {
    request.target = Target{segment.key->pose, segment.key->mask};
    request.hit = segment.key->hit;
    prepared.key_id = segment.key->id;
  }
  Pose stance;
  if (before.empty()) {
    stance = controls.Stance(segment.from, request.frames == 1 ? request.target : std::nullopt);
    before = {&stance, 1};
  }
  request.history = FillHistory(model, before);
  if (audio != nullptr) {
    request.has_audio = true;
    if (model.hears_music) {
      request.audio_history = audio->History(segment.from, model.history_frames);
      const auto heard = static_cast<int>(rows_end - segment.from);
      request.audio_rows = Eigen::MatrixXf::Zero(model.audio_features, request.frames);
      request.audio_rows.leftCols(heard) = audio->History(rows_end, heard);
    }
    request.energy = {HearEnergyAt(*audio, start, segment.from - kTypicalFrames),
                      HearEnergyAt(*audio, start, segment.from)};
  }
  request.seed = start.seed ^ start.music_id;
  request.noise_like = recurrence.Origins(segment.from, segment.to);
  request.variation = start.variation;
  request.style = start.style;
  request.temperature = start.temperature.value_or(static_cast<float>(model.default_temperature));
  controls.FillControls(prepared.key_id, &request, &prepared.warnings);
  return prepared;
}

void WarnOfSpeed(const ModelInfo& model, const TransitionRun& run, PreparedTransition* prepared) {
  const std::optional<RequiredSpeed> speed = run.required_speed();
  if (!speed || !speed->TooFast()) return;
  prepared->warnings.push_back(IntervalTooShort(model.skeleton, prepared->key_id,
                                                prepared->request.first_frame,
                                                prepared->request.frames, *speed));
}

}  // namespace choreo
