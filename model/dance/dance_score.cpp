#include "model/dance/dance_score.h"

#include <algorithm>
#include <utility>

#include "model/motion/pose_faults.h"

namespace choreo {
namespace {

const std::vector<Passage> kNoPassages;

// The energy of the music before a frame.
double HearEnergyAt(const AudioFeed& audio, const DanceManner& manner, int64_t frame) {
  return manner.music_dynamics * HearEnergy(audio.Sounds(frame, kDynamicsMemory));
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

PreparedTransition PrepareTransition(const ModelInfo& model, const TransitionInputs& inputs,
                                     std::vector<double> beats) {
  const auto& [manner, controls, segment, before, noise_like, audio, rows_end] = inputs;
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
  if (before.history.empty()) {
    const Pose stance =
        controls.Stance(segment.from, spec.frames == 1 ? spec.target : std::nullopt);
    spec.history = FillHistory(model, {&stance, 1});
  } else {
    spec.history = FillHistory(model, before.history);
  }
  spec.stage = before.stage;
  if (audio != nullptr) {
    if (model.hears_music) {
      const auto heard = static_cast<int>(rows_end - segment.from);
      auto& music = spec.paper.music.emplace();
      music.history = audio->History(segment.from, model.history_frames);
      music.rows = Eigen::MatrixXf::Zero(model.audio_features, spec.frames);
      music.rows.leftCols(heard) = audio->History(rows_end, heard);
    }
    spec.energy = {HearEnergyAt(*audio, manner, segment.from - kTypicalFrames),
                   HearEnergyAt(*audio, manner, segment.from)};
  }
  spec.beats = std::move(beats);
  spec.seed = manner.seed ^ manner.music_id;
  spec.noise_like = noise_like;
  spec.variation = manner.variation;
  spec.style = manner.style;
  spec.temperature = manner.temperature.value_or(static_cast<float>(model.default_temperature));
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

DanceScore::DanceScore(const ModelInfo& model, const ValidDance& asked, const AudioFeed* audio)
    : timeline({model.fps, asked->FirstFrame(), asked->end_frame, audio != nullptr,
                asked->generate_until, model.max_transition_frames, model.sight_frames}),
      controls(model),
      beats(model.fps, asked->music_beats, audio, asked->music_downbeats),
      recurrence(model.fps, asked->variation < 1 ? asked->music_passages : kNoPassages),
      model_(model),
      audio_(audio),
      first_frame_(asked->FirstFrame()),
      end_frame_(asked->end_frame),
      has_beats_(!asked->music_beats.empty()),
      manner_(*asked),
      // A model that hears music hears that of the transition itself.
      turn_(asked->music_dynamics > 0 && !model.hears_music) {
  if (asked->continuation) reached_before_ = asked->continuation->reached;
  if (!recurrence.empty()) timeline.SetCuts(CutsOf(asked->music_passages, model.fps));
}

void DanceScore::SetMusic(const MusicAnalysis& music) {
  if (manner_.music_id == 0) manner_.music_id = music.id;
  if (!has_beats_) beats.ReplaceAll(music);
  if (!recurrence.empty() || music.passages.empty() || manner_.variation >= 1) return;
  recurrence = Recurrence(model_.fps, music.passages);
  timeline.SetCuts(CutsOf(music.passages, model_.fps));
}

DanceEvent DanceScore::AnswerLate(const KeyRejected& rejection, std::optional<HandPose> hands) {
  const auto reached = std::ranges::find_if(reached_before_, [&](const KeyReached& key) {
    return key.id == rejection.id && key.frame == rejection.frame;
  });
  if (reached == reached_before_.end()) return rejection;
  KeyReached again = *reached;
  again.hands = hands;
  reached_before_.erase(reached);
  return again;
}

bool DanceScore::EndsBy(int64_t frame) const {
  const std::optional<int64_t> end = timeline.End();
  return end && frame >= *end;
}

bool DanceScore::Overtakes(int64_t frame) {
  return frame >= timeline.Planned()->stop || EndsBy(frame);
}

bool DanceScore::TurnWithMusic(size_t planned, int64_t ready) {
  if (audio_ == nullptr || planned == 0) return true;
  const int64_t stop = timeline.Planned(planned - 1)->stop;
  const std::optional<int64_t> turn = turn_.Find(*audio_, ready, stop);
  if (turn) timeline.StopAt(*turn);
  return turn || ready >= stop;
}

std::optional<DanceScore::Next> DanceScore::TakeNext(size_t planned, int64_t ready) {
  if (!TurnWithMusic(planned, ready)) return std::nullopt;
  const Segment* segment = timeline.Planned(planned);
  if (segment == nullptr || EndsBy(segment->from) || !timeline.IsCertain(segment->from))
    return std::nullopt;
  int64_t rows_end = segment->from;
  if (model_.hears_music) rows_end = std::min(segment->to, end_frame_.value_or(segment->to));
  // Beats of the whole music are set before its first row is ready, so a transition that waits for
  // one row knows them.
  if (audio_ != nullptr && ready < std::max(rows_end, first_frame_ + 1)) return std::nullopt;
  if (audio_ != nullptr) turn_.Watch(*audio_, *segment);
  recurrence.Begin(segment->from);
  return Next{{.manner = manner_,
               .controls = controls,
               .segment = *segment,
               .noise_like = recurrence.Origins(segment->from, segment->to),
               .audio = audio_,
               .rows_end = rows_end},
              beats.PlanFrom(segment->from)};
}

}  // namespace choreo
