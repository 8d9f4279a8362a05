#include "model/dance/dance_chain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/core/error.h"
#include "model/dance/scheduled_transition.h"

namespace choreo {

/// One transition of the chain. Its run changes with the chain's mutex held.
class DanceChain::Job : public ScheduledTransition {
 public:
  Job(std::shared_ptr<DanceChain> chain, const Segment& segment, AskedTransition asked)
      : ScheduledTransition(
            chain->model_, std::move(asked), chain->audio(),
            chain->start_time_ + chain->Seconds(segment.from - chain->first_frame_)),
        chain_(std::move(chain)),
        segment_(segment) {}

  bool Ready() const override {
    std::lock_guard lock(chain_->mutex_);
    if (chain_->paused_) return false;
    const int64_t frame = NextFrame();
    const Segment* current = chain_->timeline_.Current();  // null: this one is done
    return current != nullptr && frame < current->stop && chain_->timeline_.Certain(frame) &&
           (!chain_->audio_ || chain_->audio_->ready() > frame);
  }

  void OnRestart() override {
    std::lock_guard lock(chain_->mutex_);
    ScheduledTransition::OnRestart();
  }

  bool OnFrame(const StepOutput& raw) override {
    bool more = false;
    {
      std::lock_guard lock(chain_->mutex_);
      const std::optional<DanceFrame> frame = TakeNew(raw);
      if (!frame) return true;
      chain_->Emit(*this, *frame);
      more = !chain_->CurrentIsDanced();
    }
    chain_->mailbox_.Deliver();
    return more;
  }

  void OnDone(const Error* failure) noexcept override {
    chain_->Act([this, failure] {
      chain_->job_ = nullptr;
      if (failure != nullptr && !retired_) return chain_->mailbox_.PostError(*failure);
      chain_->timeline_.Finish();
      if (danced() > 0) chain_->PostContinuation();
      chain_->Advance(/*inherits=*/true);
    });
  }

  bool Cancelled() const override { return retired_ || chain_->cancelled_; }

  /// The dance, or the transition, turned out to end before the next frame: it ends in good order.
  void Retire() { retired_ = true; }

  const Segment& segment() const { return segment_; }

 private:
  const std::shared_ptr<DanceChain> chain_;
  const Segment segment_;
  std::atomic<bool> retired_ = false;
};

DanceChain::DanceChain(Scheduler& scheduler, const DanceConfig& config,
                       std::shared_ptr<DanceSink> sink)
    : scheduler_(scheduler),
      model_(scheduler.model()),
      config_(config),
      first_frame_(config.FirstFrame()),
      mailbox_(std::move(sink)),
      audio_(config.audio
                 ? std::make_unique<AudioFeed>(config.audio->sample_rate, config.audio->channels,
                                               config.audio->first_sample)
                 : nullptr),
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
    if (over()) return;
    change(timeline_);
    if (job_ != nullptr && CurrentIsDanced()) job_->Retire();
    Advance(/*inherits=*/false);
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

void DanceChain::SetMusicBeats(const std::vector<double>& seconds) {
  std::lock_guard lock(mutex_);
  beats_.Find(seconds);
}

void DanceChain::SetPaused(bool paused) {
  paused_ = paused;
  if (!paused) Act([this] { Advance(/*inherits=*/false); });
}

void DanceChain::Cancel() noexcept {
  cancelled_ = true;
  Act([this] { Advance(/*inherits=*/false); });  // where a job runs, its OnDone follows
}

void DanceChain::Act(const std::function<void()>& act) noexcept {
  try {
    {
      std::lock_guard lock(mutex_);
      act();
    }
    mailbox_.Deliver();
  } catch (...) {
    mailbox_.GiveUp();
  }
}

bool DanceChain::CurrentIsDanced() {
  // No step can be under way past either: NextInput lets only certain frames through.
  const std::optional<int64_t> end = timeline_.End();
  return next_frame_ >= timeline_.Current()->stop || (end && next_frame_ >= *end);
}

void DanceChain::Advance(bool inherits) {
  if (job_ != nullptr) return scheduler_.Wake(job_);
  if (over()) return;
  if (cancelled_) return mailbox_.PostError(Error(ErrorCode::kCancelled, "", "cancelled"));
  const std::optional<int64_t> end = timeline_.End();
  if (timeline_.complete() && end && next_frame_ >= *end) return Summarise();
  const Segment* segment = timeline_.Current();
  if (segment == nullptr || paused_ || !timeline_.Certain(segment->from)) return;
  // A slot that is held already is kept while the music catches up; a new one is asked for when the
  // first frame can be made. Rows before the first frame are there once that frame's predecessor
  // has been danced.
  if (!audio_ || audio_->ready() > (inherits ? segment->from - 1 : segment->from)) Start(*segment);
}

void DanceChain::Start(const Segment& segment) {
  // Who waited for itself is due from now on: no right to be first grows out of waiting.
  start_time_ = std::max(start_time_, PlaybackClock() - Seconds(segment.from - first_frame_));
  try {
    AskedTransition asked = AskTransition(config_, model_, controls_, audio(), segment, history_);
    asked.request.stage = stage_;
    asked.request.beats = beats_.Around(segment.from, segment.to);
    history_ = asked.request.history;
    // The next one may begin a frame later.
    if (audio_) audio_->Forget(segment.from - model_.history_frames);
    const auto job = std::make_shared<Job>(shared_from_this(), segment, std::move(asked));
    scheduler_.Submit(job);
    job_ = job.get();  // until its OnDone, which waits for mutex_
  } catch (const Error& error) {
    mailbox_.PostError(error);
  }
}

void DanceChain::Emit(const Job& job, const DanceFrame& frame) {
  const TransitionRun& run = job.run();
  if (run.done() == 1) {
    for (const DanceWarning& warning : job.warnings()) Post(warning);
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
    const Key& key = *job.segment().key;
    meter_.AddKey(key.id, *run.arrival());
    Post(KeyReached{key.id, key.frame, Seconds(key.frame), *run.arrival()});
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
  if (const auto warning = controls_.BehindEnd(next_frame_)) Post(*warning);
  const QualityReport report = meter_.Report(beats_.told());
  if (const auto warning = controls_.SpeedsMissed(report)) Post(*warning);
  mailbox_.PostLast([report](DanceSink& sink) { sink.OnSummary(report); });
}

}  // namespace choreo
