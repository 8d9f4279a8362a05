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
  chain_->Apply(&DanceScore::EndOfAudio);
  audio.Finish();
  chain_->Continue();
}

DanceStream::DanceStream(SampleQueue& queue, const ValidDance& config,
                         std::shared_ptr<DanceSink> sink)
    : model_(queue.model()), chain_(std::make_shared<DanceChain>(queue, config, std::move(sink))) {
  chain_->Begin(config);
}

DanceStream::~DanceStream() { chain_->Cancel(); }

void DanceStream::PushAudio(std::span<const float> interleaved, int64_t first_sample) {
  std::lock_guard lock(messages_);
  AudioFeed& audio = Audio("audio");
  if (chain_->over()) return;
  audio.Push(interleaved, first_sample, [this] { chain_->Continue(); });
}

void DanceStream::EndOfAudio() {
  std::lock_guard lock(messages_);
  FinishAudio();
}

void DanceStream::SetMusic(const MusicAnalysis& music) {
  chain_->Apply([&](DanceScore& score) { return score.SetMusic(music); });
}

void DanceStream::NoteMusicDamaged(const std::vector<std::string>& notes, double seconds) {
  chain_->Apply([&](DanceScore&) { return DanceEvents{MusicDamaged(notes, seconds, model_.fps)}; });
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
  chain_->Apply([&](DanceScore& score) { return score.SetKey(key, when, field); });
  ++keyframes_;
}

void DanceStream::RejectKey(const std::string& id, const std::optional<KeyMoment>& when,
                            const std::string& field, const std::string& reason) {
  std::lock_guard lock(messages_);
  chain_->Apply([&](DanceScore& score) { return score.RejectKey(id, when, field, reason); });
  ++keyframes_;
}

void DanceStream::RemoveKey(const std::string& id) {
  std::lock_guard lock(messages_);
  const std::string field = At("remove_keyframes", removals_);
  chain_->Apply([&](DanceScore& score) { return score.RemoveKey(id, field); });
  ++removals_;
}

void DanceStream::SetControls(const ControlRequest& request) {
  std::lock_guard lock(messages_);
  const std::string field = NextControls();
  ValidateControls(request, model_, field);
  chain_->Apply([&](DanceScore& score) { return score.SetControls(request, field); });
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
  chain_->Apply(
      [&](DanceScore& score) { return score.GiveBeats(seconds, downbeats, confidence, field); });
  ++beats_;
}

void DanceStream::GivePassages(const std::vector<Passage>& passages) {
  std::lock_guard lock(messages_);
  const std::string field = NextMusicPassages() + ".passages";
  if (passages.empty()) throw InvalidArgument(field, "empty");
  CheckPassages(passages, field);
  chain_->Apply([&](DanceScore& score) { return score.GivePassages(passages, field); });
  ++passages_;
}

void DanceStream::GenerateUntil(int64_t frame) {
  std::lock_guard lock(messages_);
  chain_->Apply([frame](DanceScore& score) { return score.GenerateUntil(frame); });
}

void DanceStream::KeysComplete() {
  std::lock_guard lock(messages_);
  chain_->Apply([](DanceScore& score) { return score.KeysComplete(); });
}

void DanceStream::HalfClose() {
  std::lock_guard lock(messages_);
  const AudioFeed* audio = chain_->audio();
  if (audio != nullptr && !audio->finished()) FinishAudio();
  chain_->Apply([](DanceScore& score) {
    return score.timeline().complete() ? DanceEvents() : score.KeysComplete();
  });
}

void DanceStream::SetPaused(bool paused) { chain_->SetPaused(paused); }
void DanceStream::Cancel() noexcept { chain_->Cancel(); }

int DanceStream::LatencyFrames(const DanceStart& config, const ModelInfo& model) {
  double seconds = 0;
  if (config.audio) {
    if (model.hearing) seconds += kTypicalFrames / model.fps;
    const FeatureStream stream(config.audio->sample_rate, config.audio->channels);
    seconds += static_cast<double>(stream.latency_samples()) / kModelSampleRate;
  }
  if (config.output_fps != model.fps) seconds += 1 / model.fps;
  return static_cast<int>(std::ceil(seconds * config.output_fps));
}

}  // namespace choreo
