#include "model/dance/dance_chain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/core/error.h"
#include "model/dance/prepared_transition.h"

namespace choreo {
namespace {

const std::vector<Passage> kNoPassages;
constexpr size_t kMaxAhead = 1;  // transitions sampled ahead of the one being handed out

}  // namespace

/// One transition of the chain, from its submission until its last frame is handed out.
class DanceChain::Job : public SampleJob {
 public:
  Job(std::shared_ptr<DanceChain> chain, const Segment& segment, PreparedTransition prepared,
      std::vector<Beat> beats)
      : chain_(std::move(chain)),
        segment_(segment),
        deadline_(chain_->start_time_ + chain_->Seconds(segment.from - chain_->first_frame_)),
        run_(chain_->model_, prepared.request),
        beats_(std::move(beats)) {
    WarnOfSpeed(chain_->model_, run_, &prepared);
    warnings_ = std::move(prepared.warnings);
  }

  /// Samples the transition slice by slice; once it is sampled, each slice hands out frames.
  bool Continue(Sampler& sampler) override {
    if (worker_has_sampled_) return chain_->HandOut(kFramesASlice);
    if (run_.Continue(sampler)) return true;
    worker_has_sampled_ = true;
    std::lock_guard lock(chain_->mutex_);
    sampled_ = true;
    chain_->SubmitNext();
    return true;
  }

  void OnDone(const Error* failure) noexcept override {
    if (failure == nullptr || retired_) return;
    chain_->React([this, failure] { chain_->Fail(*this, *failure); });
  }

  double Deadline() const override { return deadline_; }
  int frames() const override { return run_.spec().frames; }
  bool Cancelled() const override { return retired_ || chain_->cancelled_; }

  /// The chain no longer needs this transition: the queue drops it.
  void Retire() { retired_ = true; }
  void Fail(const Error& failure) { failure_ = failure; }

  /// The chain's mutex guards what the functions below read, except constants.
  bool sampled() const { return sampled_; }
  const std::optional<Error>& failure() const { return failure_; }
  const Segment& segment() const { return segment_; }
  const std::vector<Warning>& warnings() const { return warnings_; }
  const std::vector<Beat>& beats() const { return beats_; }
  /// Valid once it is sampled.
  const TransitionRun& run() const { return run_; }
  const DanceFrame& FrameAt(int64_t frame) const {
    return run_.frames()[static_cast<size_t>(frame - segment_.from)];
  }
  /// The state from which a transition that begins at `frame`, in or right after this one, starts.
  DancedState StateBefore(int64_t frame) const {
    const auto danced = static_cast<size_t>(frame - segment_.from);
    return {run_.HistoryAfter(danced), run_.StageAfter(danced)};
  }

 private:
  const std::shared_ptr<DanceChain> chain_;
  const Segment segment_;
  const double deadline_;
  TransitionRun run_;
  const std::vector<Beat> beats_;
  std::vector<Warning> warnings_;
  bool worker_has_sampled_ = false;  // read and written without a lock by the worker alone
  bool sampled_ = false;             // the same for all other threads; guarded by the chain's mutex
  std::optional<Error> failure_;
  std::atomic<bool> retired_ = false;
};

DanceChain::DanceChain(SampleQueue& queue, const ValidDance& asked, std::shared_ptr<DanceSink> sink)
    : queue_(queue),
      model_(queue.model()),
      first_frame_(asked->FirstFrame()),
      mailbox_(std::move(sink)),
      audio_(asked->audio
                 ? std::make_unique<AudioFeed>(asked->audio->sample_rate, asked->audio->channels,
                                               asked->audio->first_sample)
                 : nullptr),
      start_time_(PlaybackClock()),
      score_{*asked,
             Timeline({model_.fps, first_frame_, asked->end_frame, asked->audio.has_value(),
                       asked->generate_until, model_.max_transition_frames, model_.sight_frames}),
             ControlTrack(model_),
             MusicBeats(model_.fps, asked->music_beats,
                        asked->continuation ? asked->continuation->last_beat : std::nullopt,
                        audio(), asked->music_downbeats),
             Recurrence(model_.fps, asked->variation < 1 ? asked->music_passages : kNoPassages)},
      next_frame_(first_frame_),
      meter_(model_.skeleton, model_.fps, first_frame_,
             asked->continuation ? asked->continuation->reached : std::vector<KeyReached>()),
      output_(model_.fps, asked->output_fps, first_frame_,
              asked->continuation ? std::optional(RoundToFloat(asked->continuation->poses.back()))
                                  : std::nullopt),
      // A model that hears music hears that of the transition itself.
      turn_(asked->music_dynamics > 0 && !model_.hears_music) {
  if (!asked->Before().empty()) danced_.history = FillHistory(model_, asked->Before());
  if (asked->continuation) {
    danced_.stage = asked->continuation->stage;
    reached_before_ = asked->continuation->reached;
  }
  if (!score_.recurrence.empty())
    score_.timeline.SetCuts(CutsOf(asked->music_passages, model_.fps));
}

void DanceChain::Begin() {
  for (const Warning& warning : score_.config.Warnings(model_, first_frame_)) Post(warning);
  Apply([](DanceScore&) {});  // starts frames that the config has granted
}

void DanceChain::Apply(const std::function<void(DanceScore&)>& change) {
  {
    std::lock_guard lock(mutex_);
    if (over()) return;
    change(score_);
    SubmitNext();
  }
  while (HandOut(kFramesASlice)) {
  }
}

void DanceChain::SetPaused(bool paused) {
  paused_ = paused;
  if (!paused) React([] {});
}

void DanceChain::Cancel() noexcept {
  cancelled_ = true;
  queue_.CheckCancelled();
  React([this] { mailbox_.PostError(Error(ErrorCode::kCancelled, "", "cancelled")); });
}

void DanceChain::React(const std::function<void()>& change) noexcept {
  try {
    {
      std::lock_guard lock(mutex_);
      change();
      SubmitNext();
    }
    while (HandOut(kFramesASlice)) {
    }
  } catch (...) {
    mailbox_.GiveUp();
    std::lock_guard lock(mutex_);
    DropJobs();
  }
}

// Jobs keep the chain alive, and the chain its jobs: this breaks the cycle.
void DanceChain::DropJobs() {
  if (jobs_.empty()) return;
  for (const std::shared_ptr<Job>& job : jobs_) job->Retire();
  jobs_.clear();
  queue_.CheckCancelled();
}

bool DanceChain::HandOut(int most) {
  std::unique_lock lock(mutex_);
  look_again_ = true;
  if (std::exchange(handing_out_, true)) return false;
  for (int count = 0; count < most && look_again_; ++count) {
    look_again_ = HandOutNext();
    lock.unlock();
    try {
      mailbox_.Deliver();  // the sink may pause the dance
    } catch (...) {
      lock.lock();
      handing_out_ = false;
      throw;
    }
    lock.lock();
  }
  handing_out_ = false;
  return look_again_;
}

void DanceChain::Fail(Job& job, const Error& failure) {
  if (!job.sampled()) {
    job.Fail(failure);  // reported when all frames before it are handed out
  } else if (failure.code() != ErrorCode::kUnavailable) {
    // The sink threw it. A closing queue (kUnavailable) does not take back sampled frames.
    mailbox_.PostError(failure);
  }
}

bool DanceChain::IsOver(const Segment& segment) const {
  const std::optional<int64_t> end = score_.timeline.End();
  return next_frame_ >= segment.stop || (end && next_frame_ >= *end);
}

bool DanceChain::HandOutNext() {
  if (over()) {
    DropJobs();
    return false;
  }
  if (paused_) return false;
  if (jobs_.empty()) {
    const std::optional<int64_t> end = score_.timeline.End();
    if (failure_) {
      mailbox_.PostError(*failure_);
    } else if (score_.timeline.complete() && end && next_frame_ >= *end) {
      Summarise();
    } else {
      return false;
    }
    return true;
  }
  const int64_t ready = audio_ ? audio_->ready() : 0;
  TurnWithMusic(ready);
  Job& job = *jobs_.front();
  if (IsOver(*score_.timeline.Planned())) {
    if (!job.sampled()) {  // a sampled job may be handing out frames right now
      job.Retire();
      queue_.CheckCancelled();
    }
    score_.timeline.Finish();
    if (next_frame_ > job.segment().from) {
      danced_ = job.StateBefore(next_frame_);
      PostContinuation();
    }
    jobs_.pop_front();
    // No frame follows the end, so no transition is needed any more.
    if (const std::optional<int64_t> end = score_.timeline.End(); end && next_frame_ >= *end)
      DropJobs();
    SubmitNext();
    return true;
  }
  if (job.failure()) {
    mailbox_.PostError(*job.failure());
    return true;
  }
  if (!job.sampled() || !score_.timeline.IsCertain(next_frame_)) return false;
  if (audio_ && ready <= next_frame_) return false;
  Emit(job, job.FrameAt(next_frame_));
  return true;
}

bool DanceChain::TurnWithMusic(int64_t ready) {
  if (!audio_ || jobs_.empty()) return true;
  const int64_t stop = score_.timeline.Planned(jobs_.size() - 1)->stop;
  const std::optional<int64_t> turn = turn_.Find(*audio_, ready, stop);
  if (turn) score_.timeline.StopAt(*turn);
  return turn || ready >= stop;
}

void DanceChain::SubmitNext() {
  if (over() || cancelled_ || failure_ || jobs_.size() > kMaxAhead) return;
  if (!jobs_.empty() && !jobs_.back()->sampled()) return;  // the start of the next is not known yet
  const int64_t ready = audio_ ? audio_->ready() : 0;
  if (!TurnWithMusic(ready)) return;
  const Segment* segment = score_.timeline.Planned(jobs_.size());
  const std::optional<int64_t> end = score_.timeline.End();
  if (segment == nullptr || (end && segment->from >= *end) ||
      !score_.timeline.IsCertain(segment->from))
    return;
  int64_t rows_end = segment->from;
  if (model_.hears_music)
    rows_end = std::min(segment->to, score_.config.end_frame.value_or(segment->to));
  // Beats of the whole music are set before its first row is ready, so a transition that waits for
  // one row knows them.
  if (!audio_ || ready >= std::max(rows_end, first_frame_ + 1)) Submit(*segment, rows_end);
}

void DanceChain::Submit(const Segment& segment, int64_t rows_end) {
  // A dance that waited for its client's messages is due from now on. Its old start time would let
  // it overtake dances that waited for nobody.
  start_time_ = std::max(start_time_, PlaybackClock() - Seconds(segment.from - first_frame_));
  score_.recurrence.Begin(segment.from);
  try {
    const DancedState before = jobs_.empty() ? danced_ : jobs_.back()->StateBefore(segment.from);
    std::vector<Beat> beats = score_.beats.BeatsFor(segment.from, segment.to);
    PreparedTransition prepared =
        PrepareTransition({.start = score_.config,
                           .model = model_,
                           .controls = score_.controls,
                           .recurrence = score_.recurrence,
                           .audio = audio(),
                           .segment = segment,
                           .rows_end = rows_end,
                           .before = before.history,
                           .stage = before.stage,
                           .beats = score_.beats.BeatTimes(beats, segment.from, segment.to)});
    if (audio_) turn_.Watch(*audio_, segment);
    auto job =
        std::make_shared<Job>(shared_from_this(), segment, std::move(prepared), std::move(beats));
    queue_.Submit(job);
    jobs_.push_back(std::move(job));  // its reports wait for mutex_
  } catch (const Error& error) {
    failure_ = error;
  }
}

void DanceChain::Emit(const Job& job, const DanceFrame& frame) {
  const TransitionRun& run = job.run();
  const Segment& segment = job.segment();
  if (next_frame_ == segment.from) {
    for (const Warning& warning : job.warnings()) Post(warning);
    score_.beats.StartReporting(job.beats(), segment.from);
    // A resumed dance may begin a frame later.
    if (audio_) audio_->Forget(segment.from - model_.history_frames);
  }
  const int64_t emitted = next_frame_++;
  meter_.Add(frame);
  OutputFrames frames = output_.Push(frame);
  if (!frames.poses.empty()) {
    mailbox_.Post([frames = std::move(frames)](DanceSink& sink) {
      sink.OnFrames(frames.first_frame, frames.poses, frames.contacts);
    });
  }
  for (const Beat& beat : score_.beats.TakeBeatsAt(emitted)) Post(beat);
  if (next_frame_ == segment.to && run.arrival()) {
    const Key& key = *score_.timeline.Planned()->key;  // its hands may be newer than the job's
    KeyReached reached = *run.arrival();
    reached.id = key.id;
    meter_.AddKey(reached);
    reached.hands = key.hands;
    Post(reached);
  }
}

void DanceChain::Post(const DanceEvent& event) {
  mailbox_.Post([event](DanceSink& sink) { sink.OnEvent(event); });
}

void DanceChain::PostLate(const KeyRejected& rejection, std::optional<HandPose> hands) {
  const auto reached = std::ranges::find_if(reached_before_, [&](const KeyReached& key) {
    return key.id == rejection.id && key.frame == rejection.frame;
  });
  if (reached == reached_before_.end()) return Post(rejection);
  reached->hands = hands;
  Post(*reached);
  reached_before_.erase(reached);
}

void DanceChain::PostContinuation() {
  Continuation continuation{next_frame_, danced_.history, model_.fingerprint};
  if (audio_) {
    continuation.audio_from_sample =
        ResumeSample(score_.config, next_frame_, model_, score_.config.music_beats.empty());
  }
  continuation.last_beat = score_.beats.last_reported();
  continuation.stage = danced_.stage;
  continuation.reached = meter_.keys();
  mailbox_.Post([continuation = std::move(continuation)](DanceSink& sink) {
    sink.OnContinuation(continuation);
  });
}

void DanceChain::Summarise() {
  if (const auto warning = score_.controls.BehindEnd(next_frame_)) Post(*warning);
  const QualityReport report = meter_.Report(score_.beats.reported());
  if (const auto warning = score_.controls.SpeedsMissed(report)) Post(*warning);
  mailbox_.PostLast([report](DanceSink& sink) { sink.OnSummary(report); });
}

}  // namespace choreo
