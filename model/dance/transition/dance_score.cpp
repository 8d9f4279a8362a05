#include "model/dance/transition/dance_score.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "model/core/range.h"
#include "model/dance/timeline/validation.h"

namespace choreo {
namespace {

const std::vector<Passage> kNoPassages;

// Whether nothing is known of the music before it sounds.
bool IsUnknown(const KnownMusic& music) {
  return music.music_beats.empty() && music.music_energies.empty() && music.music_passages.empty();
}

}  // namespace

DanceScore::DanceScore(const ModelInfo& model, const ValidDance& config, const AudioFeed* audio)
    : timeline_({model.fps, config->FirstFrame(), config->end_frame, audio != nullptr,
                 config->generate_until, model.max_transition_frames, model.sight_frames}),
      controls_(model),
      music_(model, *config, config->Dynamics(), audio),
      recurrence_(model.fps, config->Variation() < 1 ? config->music_passages : kNoPassages),
      model_(model),
      audio_(audio),
      first_frame_(config->FirstFrame()),
      end_frame_(config->end_frame),
      recurs_(config->Variation() < 1) {
  if (config->continuation) reached_before_ = config->continuation->reached;
  if (!recurrence_.empty()) timeline_.SetCuts(CutsOf(config->music_passages, model.fps));
  if (audio != nullptr && recurs_ && IsUnknown(*config)) {
    timeline_.SetCutRule([this](int64_t from) {
      recurrence_.StartTransition(from);
      return recurrence_.NextCut(from + kTypicalFrames / 2);
    });
  }
}

DanceEvents DanceScore::SetKey(const Key& key, const KeyMoment& when) {
  CheckKeyPose(model_.skeleton, key.pose, "key.pose");
  CheckMask(model_.skeleton, key.mask, "key.mask");
  CheckHit(key.hit, "key.hit");
  if (const auto rejection = timeline_.Set(key, when, "key"))
    return {AnswerLate(*rejection, key.hands)};
  return KeysBehindMusic(&key.id);
}

DanceEvents DanceScore::RejectKey(const std::string& id, const std::optional<KeyMoment>& when,
                                  const std::string& field, const std::string& reason) {
  KeyRejected rejection = timeline_.RejectInvalid(id, when, reason);
  rejection.field = field;
  return {rejection};
}

DanceEvents DanceScore::RemoveKey(const std::string& id) {
  if (const auto rejection = timeline_.Remove(id, "removed_key")) return {*rejection};
  return {};
}

DanceEvents NoteChanges(const std::vector<ControlChange>& changes, int64_t first_frame,
                        int64_t from, Timeline* timeline) {
  DanceEvents events;
  for (const auto& [label, changed] : changes) {
    timeline->NoteChange(changed.first, changed.last);
    // Frames before the first one were danced before the resume, so this is not late.
    if (changed.last < from && changed.last >= first_frame)
      events.push_back(ControlsTooLate(label, changed.last, from));
  }
  return events;
}

DanceEvents DanceScore::SetControls(const ControlRequest& request) {
  const std::string field = "controls";
  CheckControls(request, model_, field);
  const int64_t from = timeline_.Frontier(field);
  return NoteChanges(controls_.Set(request, from, field), first_frame_, from, &timeline_);
}

DanceEvents DanceScore::GiveBeats(const std::vector<double>& seconds,
                                  const std::vector<double>& downbeats,
                                  std::optional<double> confidence) {
  const std::string field = "beats";
  if (seconds.empty()) throw InvalidArgument(field, "empty");
  CheckBeats(seconds, field);
  CheckDownbeats(downbeats, seconds, "downbeats");
  if (confidence) Range().Check(*confidence, "confidence");
  const int64_t from = timeline_.Frontier(field);
  const int64_t late = music_.GiveBeats(seconds, from, field, downbeats, confidence);
  if (late == 0) return {};
  return {BeatsTooLate(std::llround(seconds.front() * model_.fps), late, from)};
}

DanceEvents DanceScore::GivePassages(const std::vector<Passage>& passages) {
  const std::string field = "passages";
  if (passages.empty()) throw InvalidArgument(field, "empty");
  CheckPassages(passages, field);
  recurrence_.Give(passages, timeline_.Frontier(field), field);
  return {};
}

DanceEvents DanceScore::GenerateUntil(int64_t frame) {
  timeline_.GenerateUntil(frame);
  return {};
}

DanceEvents DanceScore::KeysComplete() {
  timeline_.Complete();
  return {};
}

DanceEvents DanceScore::EndOfAudio() {
  const int64_t end = audio_->EndFrame(model_.fps);
  timeline_.SetAudioEnd(end);
  DanceEvents events;
  if (audio_->silent()) events.push_back(MusicSilent(end - 1, audio_->seconds()));
  if (audio_->cancels()) events.push_back(ChannelsCancel(end - 1));
  for (DanceEvent& behind : KeysBehindMusic()) events.push_back(std::move(behind));
  // Tolerates clients that round times to frames, up or down.
  const auto beats = music_.GivenAfter(static_cast<double>(end + 1) / model_.fps);
  if (!beats.empty()) events.push_back(BeatsBehindMusic(end, beats.size(), beats.front()));
  if (end_frame_ && *end_frame_ > end + 1) {
    events.push_back(DanceBehindMusic(end, static_cast<double>(*end_frame_ - end) / model_.fps));
  }
  return events;
}

DanceEvents DanceScore::KeysBehindMusic(const std::string* only) const {
  DanceEvents events;
  for (const Key* key : timeline_.KeysBehindMusic()) {
    if (only != nullptr && key->id != *only) continue;
    events.push_back(KeyBehindMusic(key->id, key->frame, timeline_.SecondsBehindMusic(key->frame)));
  }
  return events;
}

DanceEvents DanceScore::SetMusic(const MusicAnalysis& music) {
  music_.SetWhole(music);
  timeline_.SetCutRule({});
  if (!recurrence_.empty() || music.passages.empty() || !recurs_) return {};
  recurrence_ = Recurrence(model_.fps, music.passages);
  timeline_.SetCuts(CutsOf(music.passages, model_.fps));
  return {};
}

// The answer to a late key with these hands: rejected, or reached before the dance was resumed.
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
  const std::optional<int64_t> end = timeline_.End();
  return end && frame >= *end;
}

bool DanceScore::Overtakes(int64_t frame) {
  return frame >= timeline_.Planned()->stop || EndsBy(frame);
}

bool DanceScore::TurnWithMusic(size_t planned, int64_t ready) {
  if (audio_ == nullptr || planned == 0) return true;
  const int64_t stop = timeline_.Planned(planned - 1)->stop;
  const std::optional<int64_t> turn = music_.FindTurn(ready, stop);
  if (turn) timeline_.StopAt(*turn);
  return turn || ready >= stop;
}

std::optional<DanceScore::Next> DanceScore::TakeNext(size_t planned, int64_t ready) {
  if (!TurnWithMusic(planned, ready)) return std::nullopt;
  const Segment* segment = timeline_.Planned(planned);
  if (segment == nullptr || EndsBy(segment->from) || !timeline_.IsCertain(segment->from))
    return std::nullopt;
  int64_t rows_end = segment->from;
  if (model_.music_features) rows_end = std::min(segment->to, end_frame_.value_or(segment->to));
  // Waits for at least one row, because the beats of the whole music are set before its first row
  // is ready.
  if (audio_ != nullptr && ready < std::max(rows_end, first_frame_ + 1)) return std::nullopt;
  recurrence_.StartTransition(segment->from);
  return Next{*segment, recurrence_.Origins(segment->from, segment->to),
              music_.PlanFor(*segment, rows_end)};
}

}  // namespace choreo
