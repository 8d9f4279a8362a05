#include "model/dance/dance_stream.h"

#include <cmath>
#include <mutex>
#include <utility>

#include "model/audio/feature_stream.h"
#include "model/audio/format.h"
#include "model/core/error.h"
#include "model/dance/dance_chain.h"
#include "model/dance/validation.h"

namespace choreo {

/// Takes messages one at a time, checks them, and turns them into changes of the chain.
struct DanceStream::Impl {
  std::shared_ptr<DanceChain> chain;
  const ModelInfo* model = nullptr;
  bool has_end_frame = false;

  std::mutex messages;  // of what follows, and of the audio's pushing side; before the chain's lock
  int keyframes = 0;
  int removals = 0;
  int controls = 0;
  int beats = 0;
  bool complete = false;

  AudioFeed& Audio(const char* field) {
    AudioFeed* audio = chain->audio();
    if (audio == nullptr) throw InvalidArgument(field, "comes without config.audio");
    return *audio;
  }

  void FinishAudio() {
    AudioFeed& audio = Audio("end_of_audio");
    if (audio.finished()) {
      throw Error(ErrorCode::kFailedPrecondition, "end_of_audio", "came before");
    }
    if (audio.next_sample() == 0) throw InvalidArgument("audio", "ended without a sample");
    // Where the music ends is known before the rows behind its end can be danced.
    chain->Change([&](Timeline& timeline) { timeline.SetAudioEnd(audio.EndFrame(model->fps)); });
    audio.Finish();
    chain->Change([](Timeline&) {});
  }

  void CompleteKeys() {
    chain->Change([this](Timeline& timeline) {
      if (chain->audio() == nullptr && !has_end_frame && timeline.Empty()) {
        throw InvalidArgument("keyframes_complete",
                              "the dance has no end: no keyframe, no music and no config.frames");
      }
      timeline.Complete();
    });
    complete = true;
  }
};

DanceStream::DanceStream(Scheduler& scheduler, const DanceConfig& config,
                         std::shared_ptr<DanceSink> sink)
    : impl_(std::make_unique<Impl>()) {
  config.Validate(scheduler.model());
  impl_->chain = std::make_shared<DanceChain>(scheduler, config, std::move(sink));
  impl_->model = &scheduler.model();
  impl_->has_end_frame = config.end_frame.has_value();
  impl_->chain->Begin();
}

DanceStream::~DanceStream() { impl_->chain->Cancel(); }

void DanceStream::PushAudio(std::span<const float> interleaved, int64_t first_sample) {
  std::lock_guard message(impl_->messages);
  AudioFeed& audio = impl_->Audio("audio");
  if (impl_->chain->over()) return;
  audio.Push(interleaved, first_sample, [this] { impl_->chain->Change([](Timeline&) {}); });
}

void DanceStream::EndOfAudio() {
  std::lock_guard message(impl_->messages);
  impl_->FinishAudio();
}

void DanceStream::SetMusicBeats(const std::vector<double>& seconds) {
  impl_->chain->SetMusicBeats(seconds);
}

void DanceStream::SetKey(const std::string& id, const KeyMoment& when, const Pose& pose,
                         const PoseMask& mask) {
  std::lock_guard message(impl_->messages);
  const std::string field = "keyframes[" + std::to_string(impl_->keyframes) + "]";
  ValidatePose(impl_->model->skeleton, pose, field);
  ValidateMask(impl_->model->skeleton, mask, field + ".mask");
  impl_->chain->Change([&](Timeline& timeline) {
    if (auto rejection = timeline.Set(id, when, pose, mask, field)) impl_->chain->Post(*rejection);
  });
  ++impl_->keyframes;
}

void DanceStream::RemoveKey(const std::string& id) {
  std::lock_guard message(impl_->messages);
  const std::string field = "remove_keyframes[" + std::to_string(impl_->removals) + "]";
  impl_->chain->Change([&](Timeline& timeline) {
    if (auto rejection = timeline.Remove(id, field)) impl_->chain->Post(*rejection);
  });
  ++impl_->removals;
}

void DanceStream::SetControls(const ControlRequest& request) {
  std::lock_guard message(impl_->messages);
  const std::string field = "controls[" + std::to_string(impl_->controls) + "]";
  request.Validate(*impl_->model, field);
  impl_->chain->SetControls(request, field);
  ++impl_->controls;
}

void DanceStream::GiveBeats(const std::vector<double>& seconds) {
  std::lock_guard message(impl_->messages);
  impl_->chain->GiveBeats(seconds, "music_beats[" + std::to_string(impl_->beats) + "].times");
  ++impl_->beats;
}

void DanceStream::GenerateUntil(int64_t frame) {
  std::lock_guard message(impl_->messages);
  impl_->chain->Change([frame](Timeline& timeline) { timeline.GenerateUntil(frame); });
}

void DanceStream::KeysComplete() {
  std::lock_guard message(impl_->messages);
  impl_->CompleteKeys();
}

void DanceStream::HalfClose() {
  std::lock_guard message(impl_->messages);
  const AudioFeed* audio = impl_->chain->audio();
  if (audio != nullptr && !audio->finished()) impl_->FinishAudio();
  if (!impl_->complete) impl_->CompleteKeys();
}

void DanceStream::SetPaused(bool paused) { impl_->chain->SetPaused(paused); }
void DanceStream::Cancel() noexcept { impl_->chain->Cancel(); }

int DanceStream::LatencyFrames(const DanceStart& config, const ModelInfo& model) {
  double seconds = 0;
  if (config.audio) {
    seconds +=
        static_cast<double>(
            FeatureStream(config.audio->sample_rate, config.audio->channels).latency_samples()) /
        kModelSampleRate;
  }
  if (config.output_fps != model.fps) seconds += 1 / model.fps;
  return static_cast<int>(std::ceil(seconds * config.output_fps));
}

}  // namespace choreo
