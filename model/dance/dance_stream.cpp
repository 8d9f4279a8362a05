#include "model/dance/dance_stream.h"

#include <cmath>
#include <utility>

#include "model/audio/feature_stream.h"
#include "model/audio/format.h"
#include "model/core/error.h"
#include "model/dance/dance_chain.h"
#include "model/dance/validation.h"
#include "model/dance/warning.h"

namespace choreo {

AudioFeed& DanceStream::Audio(const char* field) {
  AudioFeed* audio = chain_->audio();
  if (audio == nullptr) throw InvalidArgument(field, "comes without config.audio_format");
  return *audio;
}

void DanceStream::FinishAudio() {
  AudioFeed& audio = Audio("end_of_audio");
  if (audio.finished()) throw Error(ErrorCode::kFailedPrecondition, "end_of_audio", "came before");
  if (audio.next_sample() == 0) throw InvalidArgument("audio", "ended without a sample");
  // Sets the end of the music before rows after it can be danced.
  chain_->Apply([&](DanceScore& score) {
    const int64_t end = audio.EndFrame(model_.fps);
    score.timeline.SetAudioEnd(end);
    if (audio.silent()) chain_->Post(MusicSilent(end - 1, audio.seconds()));
    if (audio.cancels()) chain_->Post(ChannelsCancel(end - 1));
    WarnOfKeysBehind(score.timeline);
  });
  audio.Finish();
  chain_->Apply([](DanceScore&) {});
}

void DanceStream::WarnOfKeysBehind(const Timeline& timeline, const std::string* only) {
  for (const Key* key : timeline.KeysBehindMusic()) {
    if (only != nullptr && key->id != *only) continue;
    chain_->Post(KeyBehindMusic(key->id, key->frame, timeline.SecondsBehindMusic(key->frame)));
  }
}

DanceStream::DanceStream(SampleQueue& queue, const ValidDance& config,
                         std::shared_ptr<DanceSink> sink)
    : model_(queue.model()),
      first_frame_(config->FirstFrame()),
      chain_(std::make_shared<DanceChain>(queue, config, std::move(sink))) {
  chain_->Begin(config);
}

DanceStream::~DanceStream() { chain_->Cancel(); }

void DanceStream::PushAudio(std::span<const float> interleaved, int64_t first_sample) {
  std::lock_guard lock(messages_);
  AudioFeed& audio = Audio("audio");
  if (chain_->over()) return;
  audio.Push(interleaved, first_sample, [this] { chain_->Apply([](DanceScore&) {}); });
}

void DanceStream::EndOfAudio() {
  std::lock_guard lock(messages_);
  FinishAudio();
}

void DanceStream::SetMusic(const MusicAnalysis& music) {
  chain_->Apply([&](DanceScore& score) { score.SetMusic(music); });
}

void DanceStream::NoteMusicDamaged(const std::vector<std::string>& notes, double seconds) {
  chain_->Apply([&](DanceScore&) { chain_->Post(MusicDamaged(notes, seconds, model_.fps)); });
}

std::string DanceStream::NextKeyframe() const { return At("keyframes", keyframes_); }
std::string DanceStream::NextControls() const { return At("controls", controls_); }
std::string DanceStream::NextMusicBeats() const { return At("music_beats", beats_); }
std::string DanceStream::NextMusicPassages() const { return At("music_passages", passages_); }

void DanceStream::SetKey(const Key& key, const KeyMoment& when) {
  std::lock_guard lock(messages_);
  const std::string field = NextKeyframe();
  ValidatePose(model_.skeleton, key.pose, field);
  ValidateMask(model_.skeleton, key.mask, field + ".mask");
  ValidateHit(key.hit, field + ".hit");
  chain_->Apply([&](DanceScore& score) {
    if (auto rejection = score.timeline.Set(key, when, field)) {
      chain_->Post(score.AnswerLate(*rejection, key.hands));
    } else {
      WarnOfKeysBehind(score.timeline, &key.id);
    }
  });
  ++keyframes_;
}

void DanceStream::RejectKey(const std::string& id, const std::optional<KeyMoment>& when,
                            const std::string& field, const std::string& reason) {
  std::lock_guard lock(messages_);
  chain_->Apply([&](DanceScore& score) {
    KeyRejected rejection = score.timeline.RejectInvalid(id, when, reason);
    rejection.field = field;
    chain_->Post(rejection);
  });
  ++keyframes_;
}

void DanceStream::RemoveKey(const std::string& id) {
  std::lock_guard lock(messages_);
  const std::string field = At("remove_keyframes", removals_);
  chain_->Apply([&](DanceScore& score) {
    if (auto rejection = score.timeline.Remove(id, field)) chain_->Post(*rejection);
  });
  ++removals_;
}

void DanceStream::SetControls(const ControlRequest& request) {
  std::lock_guard lock(messages_);
  const std::string field = NextControls();
  ValidateControls(request, model_, field);
  chain_->Apply([&](DanceScore& score) {
    const int64_t from = score.timeline.Frontier(field);
    score.controls.Set(request, from, field);
    if (request.velocity_factors) score.timeline.NoteChange();
    if (!request.root_path) return;
    const int64_t last = request.root_path->frames.back();
    score.timeline.NoteChange(request.root_path->frames.front(), last);
    // A path that lies before the first frame was danced before the resume: it is not late.
    if (last < from && last >= first_frame_) chain_->Post(ControlsTooLate(last, from));
  });
  ++controls_;
}

void DanceStream::GiveBeats(const std::vector<double>& seconds,
                            const std::vector<double>& downbeats,
                            std::optional<double> confidence) {
  std::lock_guard lock(messages_);
  const std::string field = NextMusicBeats() + ".times";
  if (seconds.empty()) throw InvalidArgument(field, "empty");
  CheckBeats(seconds, field);
  CheckDownbeats(downbeats, seconds, NextMusicBeats() + ".downbeats");
  if (confidence) ValidateShare(*confidence, NextMusicBeats() + ".confidence");
  chain_->Apply([&](DanceScore& score) {
    const int64_t from = score.timeline.Frontier(field);
    if (const int64_t late = score.beats.AddGiven(seconds, from, field, downbeats, confidence);
        late > 0)
      chain_->Post(BeatsTooLate(std::llround(seconds.front() * model_.fps), late, from));
  });
  ++beats_;
}

void DanceStream::GivePassages(const std::vector<Passage>& passages) {
  std::lock_guard lock(messages_);
  const std::string field = NextMusicPassages() + ".passages";
  if (passages.empty()) throw InvalidArgument(field, "empty");
  CheckPassages(passages, field);
  chain_->Apply([&](DanceScore& score) {
    score.recurrence.Give(passages, score.timeline.Frontier(field), field);
  });
  ++passages_;
}

void DanceStream::GenerateUntil(int64_t frame) {
  std::lock_guard lock(messages_);
  chain_->Apply([frame](DanceScore& score) { score.timeline.GenerateUntil(frame); });
}

void DanceStream::KeysComplete() {
  std::lock_guard lock(messages_);
  chain_->Apply([](DanceScore& score) { score.timeline.Complete(); });
}

void DanceStream::HalfClose() {
  std::lock_guard lock(messages_);
  const AudioFeed* audio = chain_->audio();
  if (audio != nullptr && !audio->finished()) FinishAudio();
  chain_->Apply([](DanceScore& score) {
    if (!score.timeline.complete()) score.timeline.Complete();
  });
}

void DanceStream::SetPaused(bool paused) { chain_->SetPaused(paused); }
void DanceStream::Cancel() noexcept { chain_->Cancel(); }

int DanceStream::LatencyFrames(const DanceStart& config, const ModelInfo& model) {
  double seconds = 0;
  if (config.audio) {
    if (model.hears_music) seconds += kTypicalFrames / model.fps;
    const FeatureStream stream(config.audio->sample_rate, config.audio->channels);
    seconds += static_cast<double>(stream.latency_samples()) / kModelSampleRate;
  }
  if (config.output_fps != model.fps) seconds += 1 / model.fps;
  return static_cast<int>(std::ceil(seconds * config.output_fps));
}

}  // namespace choreo
