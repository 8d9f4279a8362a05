#include "model/dance/prepared_transition.h"

#include <algorithm>
#include <utility>

#include "model/motion/pose_faults.h"

namespace choreo {
namespace {

// The energy of the music before a frame.
double HearEnergyAt(const AudioFeed& audio, const DanceStart& start, int64_t frame) {
  return start.music_dynamics * HearEnergy(audio.Sounds(frame, kDynamicsMemory));
}

// Warns of the key's faults, except those that the pose before it has, as when a pose is held.
void WarnOfPose(const Skeleton& skeleton, const Pose& before, int64_t frame, const Target& key,
                PreparedTransition* prepared) {
  const std::vector<std::string> told = PoseFaults(skeleton, before, key.mask);
  for (const std::string& fault : PoseFaults(skeleton, key.pose, key.mask)) {
    if (std::ranges::find(told, fault) == told.end())
      prepared->warnings.push_back(KeyImpossible(prepared->key_id, frame, fault));
  }
}

}  // namespace

PreparedTransition PrepareTransition(const TransitionInputs& inputs) {
  const auto& [start, model, controls, recurrence, audio, segment, rows_end, before, stage, beats] =
      inputs;
  PreparedTransition prepared;
  TransitionSpec& spec = prepared.request.spec;
  spec.frames = static_cast<int>(segment.to - segment.from);
  spec.first_frame = segment.from;
  if (segment.key) {
    spec.target = Target{segment.key->pose, segment.key->mask};
    prepared.request.hit = segment.key->hit;
    prepared.key_id = segment.key->id;
  } else if (segment.later) {
    const Key& key = *segment.later;
    spec.later = {{key.pose, key.mask}, static_cast<int>(key.frame + 1 - segment.to)};
  }
  if (before.empty()) {
    const Pose stance =
        controls.Stance(segment.from, spec.frames == 1 ? spec.target : std::nullopt);
    spec.history = FillHistory(model, {&stance, 1});
  } else {
    spec.history = FillHistory(model, before);
  }
  spec.stage = stage;
  if (audio != nullptr) {
    spec.has_audio = true;
    if (model.hears_music) {
      spec.audio_history = audio->History(segment.from, model.history_frames);
      const auto heard = static_cast<int>(rows_end - segment.from);
      spec.audio_rows = Eigen::MatrixXf::Zero(model.audio_features, spec.frames);
      spec.audio_rows.leftCols(heard) = audio->History(rows_end, heard);
    }
    spec.energy = {HearEnergyAt(*audio, start, segment.from - kTypicalFrames),
                   HearEnergyAt(*audio, start, segment.from)};
  }
  spec.beats = beats;
  spec.seed = start.seed ^ start.music_id;
  spec.noise_like = recurrence.Origins(segment.from, segment.to);
  spec.variation = start.variation;
  spec.style = start.style;
  spec.temperature = start.temperature.value_or(static_cast<float>(model.default_temperature));
  controls.FillControls(prepared.key_id, &spec, &prepared.warnings);
  if (spec.target)
    WarnOfPose(model.skeleton, spec.history.back(), segment.to - 1, *spec.target, &prepared);
  return prepared;
}

void WarnOfSpeed(const ModelInfo& model, const TransitionRun& run, PreparedTransition* prepared) {
  const std::optional<RequiredSpeed> speed = run.required_speed();
  if (!speed || !speed->TooFast()) return;
  prepared->warnings.push_back(IntervalTooShort(model.skeleton, prepared->key_id,
                                                prepared->request.spec.first_frame,
                                                prepared->request.spec.frames, *speed));
}

}  // namespace choreo
