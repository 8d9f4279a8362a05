#include "model/dance/dance_chain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/core/error.h"
#include "model/dance/ask_transition.h"
#include "model/dance/dance_chain_job.h"
#include "model/dance/warning.h"

namespace choreo {

DanceChain::DanceChain(Scheduler& scheduler, const DanceConfig& config,
                       std::shared_ptr<DanceSink> sink)
    : scheduler_(scheduler),
      model_(scheduler.model()),
      config_(config),
      first_frame_(config.FirstFrame()),
      mailbox_(std::move(sink)),
      audio_(config.audio
                 ? std::optional<AudioFeed>(std::in_place, config.audio->sample_rate,
                                            config.audio->channels, config.audio->first_sample)
                 : std::optional<AudioFeed>()),
      start_time_(PlaybackClock()),
      timeline_({model_.fps, first_frame_, config.end_frame, config.audio.has_value(),
                 config.generate_until, model_.max_transition_frames}),
      controls_(model_),
      next_frame_(first_frame_),
      meter_(model_.skeleton, model_.fps, first_frame_),
      output_(model_.fps, config.output_fps, first_frame_,
              config.continuation ? std::optional(RoundToFloat(config.continuation->poses.back()))
                                  : std::nullopt),
      beats_(model_.fps, config.music_beats,
             config.continuation ? config.continuation->last_beat : std::nullopt, audio()) {
  if (!config.Before().empty()) history_ = FillHistory(model_, config.Before());
  if (config.continuation) stage_ = config.continuation->stage;
}

void DanceChain::Begin() {
  for (const DanceWarning& warning : config_.Warnings(model_, first_frame_)) Post(warning);
  Change([](Timeline&) {});  // the config may have granted frames
}

void DanceChain::Change(const std::function<void(Timeline&)>& change) {
  {
    std::lock_guard lock(mutex_);
    if (over_) return;
    change(timeline_);
    if (job_ != nullptr && CurrentIsDanced()) job_->Retire();
    Advance(/*inherits=*/false);
    WakeJob();
  }
  mailbox_.Deliver();
}

void DanceChain::SetControls(const ControlRequest& request, const std::string& field) {
  Change([&](Timeline& timeline) {
    const int64_t from = timeline.Frontier(field);
    controls_.Set(request, from, field);
    if (request.velocity_factors) timeline.Disturb();
    if (!request.root_path) return;
    const int64_t last = request.root_path->frames.back();
    timeline.Disturb(request.root_path->frames.front(), last);
    // What lies before the first frame was danced before a resume.
    if (last < from && last >= first_frame_) Post(ControlsTooLate(last, from));
  });
}

void DanceChain::GiveBeats(const std::vector<double>& seconds, const std::string& field) {
  Change([&](Timeline& timeline) {
    const int64_t from = timeline.Frontier(field);
    if (const int64_t late = beats_.Give(seconds, from, field); late > 0)
      Post(BeatsTooLate(std::llround(seconds.front() * model_.fps), late, from));
  });
}

bool DanceChain::over() const {
  std::lock_guard lock(mutex_);
  return over_;
}

void DanceChain::SetMusicBeats(const std::vector<double>& seconds) {
  std::lock_guard lock(mutex_);
  beats_.Find(seconds);
}

void DanceChain::SetPaused(bool paused) {
  paused_ = paused;
  if (paused) return;
  Act([this] {
    Advance(/*inherits=*/false);
    WakeJob();
  });
}

void DanceChain::Cancel() noexcept {
  cancelled_ = true;
  Act([this] {
    if (job_ == nullptr) Fail(Error(ErrorCode::kCancelled, "", "cancelled"));
    WakeJob();  // OnDone follows
  });
}

void DanceChain::Act(const std::function<void()>& act) noexcept {
  try {
    {
      std::lock_guard lock(mutex_);
      act();
    }
    mailbox_.Deliver();
  } catch (...) {
    GiveUp();
  }
}

void DanceChain::GiveUp() noexcept {
  {
    std::lock_guard lock(mutex_);
    over_ = true;
  }
  mailbox_.GiveUp();
}

void DanceChain::WakeJob() {
  if (job_ != nullptr) scheduler_.Wake(job_);
}

bool DanceChain::CurrentIsDanced() {
  // No step can be under way past either: NextInput lets only certain frames through.
  const std::optional<int64_t> end = timeline_.End();
  return next_frame_ >= timeline_.Current()->stop || (end && next_frame_ >= *end);
}

bool DanceChain::MayStart(const Segment& segment, bool inherits) const {
  if (paused_ || !timeline_.Certain(segment.from)) return false;
  // A slot that is held already is kept while the music catches up; a new one is asked for when the
  // first frame can be made. Rows before the first frame are there once that frame's predecessor
  // has been danced.
  return !audio_ || audio_->ready() > (inherits ? segment.from - 1 : segment.from);
}

void DanceChain::Advance(bool inherits) {
  if (over_ || job_ != nullptr) return;
  if (cancelled_) return Fail(Error(ErrorCode::kCancelled, "", "cancelled"));
  const std::optional<int64_t> end = timeline_.End();
  if (timeline_.complete() && end && next_frame_ >= *end) return Summarise();
  const Segment* segment = timeline_.Current();
  if (segment != nullptr && MayStart(*segment, inherits)) Start(*segment);
}

void DanceChain::Start(const Segment& segment) {
  // Who waited for itself is due from now on: no right to be first grows out of waiting.
  start_time_ = std::max(start_time_, PlaybackClock() - Seconds(segment.from - first_frame_));
  try {
    AskedTransition asked = AskTransition(config_, model_, controls_, audio(), segment, history_);
    asked.request.candidate = config_.candidate;
    asked.request.stage = stage_;
    asked.request.beats = beats_.Around(segment.from, segment.to);
    history_ = asked.request.history;
    // The next one may begin a frame later.
    if (audio_) audio_->Forget(segment.from - model_.history_frames);
    auto job = std::make_shared<Job>(shared_from_this(), segment, std::move(asked));
    job_ = job.get();
    scheduler_.Submit(std::move(job));
  } catch (const Error& error) {
    job_ = nullptr;
    Fail(error);
  } catch (...) {
    job_ = nullptr;
    throw;
  }
}

void DanceChain::Emit(const Segment& segment, const TransitionRun& run, const DanceFrame& frame,
                      const std::vector<DanceWarning>& warnings) {
  if (run.done() == 1) {
    for (const DanceWarning& warning : warnings) Post(warning);
    const std::optional<RequiredSpeed> speed = run.required_speed();
    if (speed && speed->TooFast()) {
      Post(IntervalTooShort(model_.skeleton, segment.key->id, segment.from,
                            segment.to - segment.from, *speed));
    }
  }
  const int64_t emitted = next_frame_++;
  MoveOn(frame.pose, &history_);
  stage_ = run.stage();
  meter_.Add(frame);
  OutputFrames frames = output_.Push(frame);
  if (!frames.poses.empty()) {
    mailbox_.Post([frames = std::move(frames)](DanceSink& sink) {
      sink.OnFrames(frames.first_frame, frames.poses, frames.contacts);
    });
  }
  for (const MusicBeat& beat : beats_.Of(emitted)) Post(beat);
  if (run.arrival()) {
    meter_.AddKey(segment.key->id, *run.arrival());
    const int64_t key_frame = segment.to - 1;
    Post(KeyReached{segment.key->id, key_frame, static_cast<double>(key_frame) / model_.fps,
                    *run.arrival()});
  }
}

void DanceChain::Post(const DanceEvent& event) {
  mailbox_.Post([event](DanceSink& sink) { sink.OnEvent(event); });
}

void DanceChain::PostContinuation() {
  Continuation continuation{next_frame_, history_, model_.fingerprint};
  if (audio_) continuation.audio_from_sample = ResumeSample(config_, next_frame_, model_);
  continuation.last_beat = beats_.last();
  continuation.stage = stage_;
  mailbox_.Post([continuation = std::move(continuation)](DanceSink& sink) {
    sink.OnContinuation(continuation);
  });
}

void DanceChain::Summarise() {
  over_ = true;
  if (const auto warning = controls_.BehindEnd(next_frame_)) Post(*warning);
  std::vector<double> beats;
  for (const double second : beats_.told()) beats.push_back(second * model_.fps);
  const QualityReport report = meter_.Report(beats);
  if (const auto warning = controls_.SpeedsMissed(report)) Post(*warning);
  mailbox_.Post([report](DanceSink& sink) { sink.OnSummary(report); });
}

void DanceChain::Fail(const Error& error) {
  if (over_) return;
  over_ = true;
  mailbox_.Post([error](DanceSink& sink) { sink.OnError(error); });
}

}  // namespace choreo
