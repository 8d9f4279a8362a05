#include "model/dance/delivery/dance_reporter.h"

#include <utility>

namespace choreo {

namespace {

std::optional<Pose> PoseBefore(const DanceStart& start) {
  if (start.Before().empty()) return std::nullopt;
  return RoundToFloat(start.Before().back());
}

}  // namespace

DanceReporter::DanceReporter(const ModelInfo& model, const ValidDance& config,
                             const AudioFeed* audio, Mailbox<DanceSink>& mailbox)
    : hears_beats_(config->music_beats.empty()),
      mailbox_(mailbox),
      beats_(model.fps, audio,
             config->continuation ? config->continuation->last_beat : std::nullopt),
      meter_(model, *config, PoseBefore(*config),
             config->continuation ? config->continuation->reached : std::vector<KeyReached>()) {}

void DanceReporter::StartTransition(const Segment& segment, const std::vector<Warning>& warnings,
                                    const std::vector<Beat>& beats) {
  for (const Warning& warning : warnings) Post(warning);
  beats_.StartTransition(beats, segment.from);
  meter_.StartTransition(segment);
}

void DanceReporter::Add(int64_t number, const DanceFrame& frame) {
  OutputFrames output = meter_.Add(number, frame);
  if (!output.poses.empty()) {
    mailbox_.Post([output = std::move(output)](DanceSink& sink) {
      sink.OnFrames(output.first_frame, output.poses, output.contacts);
    });
  }
  for (const Beat& beat : beats_.TakeAt(number)) Post(beat);
}

void DanceReporter::AddKey(const Key& key, KeyReached reached) {
  reached.id = key.id;
  meter_.AddKey(reached);
  reached.hands = key.hands;
  Post(reached);
}

void DanceReporter::End(int64_t frame, const DancedState& danced) {
  for (const Warning& warning : meter_.TakeWarnings()) Post(warning);
  Continuation continuation = meter_.ContinuationAt(frame, danced, hears_beats_);
  continuation.last_beat = beats_.last();
  continuation.reached = meter_.keys();
  mailbox_.Post([continuation = std::move(continuation)](DanceSink& sink) {
    sink.OnContinuation(continuation);
  });
}

void DanceReporter::Summarise(int64_t frame, const ControlTrack& controls) {
  for (const Warning& warning : controls.BehindEnd(frame)) Post(warning);
  const QualityReport report = meter_.Report(beats_.reported());
  for (const Warning& warning : controls.Missed(report)) Post(warning);
  mailbox_.PostLast([report](DanceSink& sink) { sink.OnSummary(report); });
}

}  // namespace choreo
