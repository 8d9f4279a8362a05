#include "model/dance/dance_report.h"

#include <cmath>
#include <utility>

#include "model/motion/resample.h"

namespace choreo {

OutputRate::OutputRate(double model_fps, double output_fps, int64_t first_frame,
                       std::optional<Pose> before)
    : model_fps_(model_fps), output_fps_(output_fps), next_input_(first_frame) {
  if (first_frame == 0) return;
  // The first output frame after the preceding model frame; earlier ones belong to the part before
  // the resume.
  const double before_at = static_cast<double>(first_frame - 1) * output_fps_ / model_fps_;
  next_output_ = static_cast<int64_t>(std::floor(before_at + kOnFrame)) + 1;
  last_ = std::move(before);
}

OutputFrames OutputRate::Push(const DanceFrame& frame) {
  OutputFrames out;
  out.first_frame = next_output_;
  const double now = static_cast<double>(next_input_);
  for (;; ++next_output_) {
    const double at = static_cast<double>(next_output_) * model_fps_ / output_fps_;
    if (at > now + kOnFrame) break;
    out.contacts.push_back(frame.contacts);
    if (at >= now - kOnFrame || !last_) {
      out.poses.push_back(frame.pose);
      continue;
    }
    const double t = at - (now - 1);
    out.poses.push_back(RoundToFloat(KeepSigns(InterpolatePoses(*last_, frame.pose, t), *last_)));
  }
  last_ = frame.pose;
  ++next_input_;
  return out;
}

Continuation ContinuationAt(int64_t frame, const DancedState& danced, const ModelInfo& model,
                            const DanceStart& asked, bool hears_beats) {
  Continuation continuation{frame, danced.history, model.fingerprint};
  if (asked.audio) continuation.audio_from_sample = ResumeSample(asked, frame, model, hears_beats);
  continuation.stage = danced.stage;
  return continuation;
}

DanceReport::DanceReport(const ModelInfo& model, const ValidDance& asked, const AudioFeed* audio,
                         Mailbox<DanceSink>& mailbox)
    : model_(model),
      asked_(*asked),
      mailbox_(mailbox),
      beats_(model.fps, audio, asked->continuation ? asked->continuation->last_beat : std::nullopt),
      meter_(model.skeleton, model.fps, asked->FirstFrame(),
             asked->continuation ? asked->continuation->reached : std::vector<KeyReached>()),
      watch_(model.skeleton, model.fps,
             asked->continuation ? std::optional(asked->continuation->poses.back()) : std::nullopt),
      output_(model.fps, asked->output_fps, asked->FirstFrame(),
              asked->continuation ? std::optional(RoundToFloat(asked->continuation->poses.back()))
                                  : std::nullopt) {}

void DanceReport::Begin(const Segment& segment, const std::vector<Warning>& warnings,
                        const std::vector<Beat>& beats) {
  for (const Warning& warning : warnings) Post(warning);
  beats_.Start(beats, segment.from);
  watch_.Begin(segment.key ? segment.key->id : "", segment.to - segment.from);
}

void DanceReport::Add(int64_t number, const DanceFrame& frame) {
  meter_.Add(frame);
  watch_.Add(number, frame.pose);
  OutputFrames frames = output_.Push(frame);
  if (!frames.poses.empty()) {
    mailbox_.Post([frames = std::move(frames)](DanceSink& sink) {
      sink.OnFrames(frames.first_frame, frames.poses, frames.contacts);
    });
  }
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
      ContinuationAt(frame, danced, model_, asked_, asked_.music_beats.empty());
  continuation.last_beat = beats_.last();
  continuation.reached = meter_.keys();
  mailbox_.Post([continuation = std::move(continuation)](DanceSink& sink) {
    sink.OnContinuation(continuation);
  });
}

void DanceReport::Summarise(int64_t frame, const ControlTrack& controls) {
  if (const auto warning = controls.BehindEnd(frame)) Post(*warning);
  const QualityReport report = meter_.Report(beats_.reported());
  if (const auto warning = controls.SpeedsMissed(report)) Post(*warning);
  mailbox_.PostLast([report](DanceSink& sink) { sink.OnSummary(report); });
}

}  // namespace choreo
