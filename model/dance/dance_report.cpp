#include "model/dance/dance_report.h"

#include <utility>

namespace choreo {

Continuation ContinuationAt(int64_t frame, const DancedState& danced, const ModelInfo& model,
                            const DanceStart& config, bool hears_beats) {
  Continuation continuation{frame, danced.history, model.fingerprint};
  if (config.audio)
    continuation.audio_from_sample = ResumeSample(config, frame, model, hears_beats);
  continuation.stage = danced.stage;
  return continuation;
}

DanceReport::DanceReport(const ModelInfo& model, const ValidDance& config, const AudioFeed* audio,
                         Mailbox<DanceSink>& mailbox)
    : model_(model),
      config_(*config),
      mailbox_(mailbox),
      beats_(model.fps, audio,
             config->continuation ? config->continuation->last_beat : std::nullopt),
      meter_(model.skeleton, model.fps, config->FirstFrame(),
             config->continuation ? config->continuation->reached : std::vector<KeyReached>()),
      watch_(model.skeleton, model.fps,
             config->Before().empty() ? std::nullopt : std::optional(config->Before().back())) {}

void DanceReport::Begin(const Segment& segment, const std::vector<Warning>& warnings,
                        const std::vector<Beat>& beats) {
  for (const Warning& warning : warnings) Post(warning);
  beats_.Start(beats, segment.from);
  watch_.Begin(segment.key ? segment.key->id : "", segment.to - segment.from);
}

void DanceReport::Add(int64_t number, const DanceFrame& frame) {
  meter_.Add(frame);
  watch_.Add(number, frame.pose);
  for (const Beat& beat : beats_.TakeAt(number)) Post(beat);
}

void DanceReport::Reach(const Key& key, KeyReached reached) {
  reached.id = key.id;
  meter_.AddKey(reached);
  reached.hands = key.hands;
  Post(reached);
}

void DanceReport::End(int64_t frame, const DancedState& danced) {
  for (const Warning& warning : watch_.Take()) Post(warning);
  Continuation continuation =
      ContinuationAt(frame, danced, model_, config_, config_.music_beats.empty());
  continuation.last_beat = beats_.last();
  continuation.reached = meter_.keys();
  mailbox_.Post([continuation = std::move(continuation)](DanceSink& sink) {
    sink.OnContinuation(continuation);
  });
}

void DanceReport::Summarise(int64_t frame, const ControlTrack& controls) {
  for (const Warning& warning : controls.BehindEnd(frame)) Post(warning);
  const QualityReport report = meter_.Report(beats_.reported());
  for (const Warning& warning : controls.Missed(report)) Post(warning);
  mailbox_.PostLast([report](DanceSink& sink) { sink.OnSummary(report); });
}

}  // namespace choreo
