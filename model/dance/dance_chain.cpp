#include "model/dance/dance_chain.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "model/core/error.h"

namespace choreo {
namespace {

constexpr size_t kMaxAhead = 1;  // transitions sampled ahead of the one being handed out

}  // namespace

/// One transition of the chain, from its submission until its last frame is handed out.
class DanceChain::Job : public SampleJob {
 public:
  Job(std::shared_ptr<DanceChain> chain, DanceScore::Next next)
      : chain_(std::move(chain)),
        segment_(next.inputs.segment),
        deadline_(chain_->start_time_ + chain_->Seconds(segment_.from - chain_->first_frame_)),
        next_(std::move(next)) {}

  bool Continue(Sampler& sampler) override {
    if (!slices_) slices_.emplace(Work(sampler));
    return slices_->Continue();
  }

  void OnDone(const Error* failure) noexcept override {
    if (failure == nullptr || retired_) return;
    if (sampled_) return chain_->OnFailure(*failure);
    chain_->React([this, failure] { Fail(*failure); });
  }

  double Deadline() const override { return deadline_; }
  int frames() const override { return static_cast<int>(segment_.to - segment_.from); }
  bool Cancelled() const override { return retired_ || chain_->cancelled_; }

  /// Cancels a transition that the chain no longer needs; the queue drops it.
  void Retire() { retired_ = true; }
  /// The failure is reported once all frames before the transition are handed out.
  void Fail(const Error& failure) { failure_ = failure; }

  bool sampled() const { return sampled_; }
  const std::optional<Error>& failure() const { return failure_; }
  const Segment& segment() const { return segment_; }

  /// Constant once sampled.
  const std::vector<Warning>& warnings() const { return warnings_; }
  const std::vector<Beat>& beats() const { return beats_; }
  const TransitionRun& run() const { return *run_; }
  const DanceFrame& FrameAt(int64_t frame) const {
    return run_->frames()[static_cast<size_t>(frame - segment_.from)];
  }
  /// The state from which a transition that begins at `frame` starts. `frame` is in this transition
  /// or directly after it.
  DancedState StateBefore(int64_t frame) const {
    return run_->StateAfter(static_cast<size_t>(frame - segment_.from));
  }

 private:
  // Prepares and samples the transition, then hands out frames.
  Slices<> Work(Sampler& sampler) {
    Prepare(*std::exchange(next_, {}));
    co_await Pause();
    co_await run_->Dance(sampler);
    {
      std::lock_guard lock(chain_->mutex_);
      sampled_ = true;
      chain_->SubmitNext();
    }
    do {
      co_await Pause();
    } while (chain_->HandOut());
  }

  void Prepare(DanceScore::Next next) {
    next.inputs.manner = chain_->manner_;
    next.inputs.seed = chain_->seed_;
    next.inputs.music = next.music.Hear();
    PreparedTransition prepared = PrepareTransition(chain_->model_, next.inputs);
    beats_ = std::move(next.inputs.music.beats);
    run_.emplace(std::move(prepared.run));
    warnings_ = std::move(prepared.warnings);
  }

  const std::shared_ptr<DanceChain> chain_;
  const Segment segment_;
  const double deadline_;
  std::optional<DanceScore::Next> next_;  // until the transition is prepared
  std::optional<TransitionRun> run_;      // once the transition is prepared
  std::vector<Beat> beats_;
  std::vector<Warning> warnings_;
  std::optional<Slices<>> slices_;  // the worker's
  std::atomic<bool> sampled_ = false;
  std::optional<Error> failure_;  // guarded by the chain's mutex
  std::atomic<bool> retired_ = false;
};

DanceChain::DanceChain(SampleQueue& queue, const ValidDance& config,
                       std::shared_ptr<DanceSink> sink)
    : queue_(queue),
      model_(queue.model()),
      manner_(*config),
      seed_(config->seed),
      first_frame_(config->FirstFrame()),
      mailbox_(std::move(sink)),
      audio_(config->audio
                 ? std::make_unique<AudioFeed>(config->audio->sample_rate, config->audio->channels,
                                               config->audio->first_sample, model_.hearing)
                 : nullptr),
      report_(model_, config, audio_.get(), mailbox_),
      output_(model_.fps, config->output_fps, first_frame_,
              config->Before().empty() ? std::nullopt
                                       : std::optional(RoundToFloat(config->Before().back()))),
      start_time_(PlaybackClock()),
      score_(model_, config, audio_.get()),
      next_frame_(first_frame_) {
  if (!config->Before().empty()) danced_.history = FillHistory(model_, config->Before());
  if (config->continuation) danced_.stage = config->continuation->stage;
}

void DanceChain::Begin(const ValidDance& config) {
  // Also starts the frames that the config has granted.
  Apply([&](DanceScore&) {
    const std::vector<Warning> warnings = config->Warnings(model_);
    return DanceEvents(warnings.begin(), warnings.end());
  });
}

void DanceChain::Apply(const std::function<DanceEvents(DanceScore&)>& change) {
  {
    std::lock_guard lock(mutex_);
    if (over()) return;
    for (const DanceEvent& event : change(score_)) PostEvent(mailbox_, event);
    SubmitNext();
  }
  HandOutHere();
}

void DanceChain::PushAudio(std::span<const float> interleaved, int64_t first_sample) {
  std::lock_guard lock(pushing_);
  AudioFeed& audio = Audio("audio");
  if (!over()) audio.Push(interleaved, first_sample, [this] { Continue(); });
}

void DanceChain::FinishAudio() {
  AudioFeed& audio = Audio("end_of_audio");
  if (audio.finished()) throw Error(ErrorCode::kFailedPrecondition, "end_of_audio", "came before");
  if (audio.next_sample() == 0) throw InvalidArgument("audio", "ended without a sample");
  // Sets the end of the music before rows after it can be danced.
  Apply(&DanceScore::EndOfAudio);
  audio.Finish();
  Continue();
}

void DanceChain::EndOfAudio() {
  std::lock_guard lock(pushing_);
  FinishAudio();
}

void DanceChain::HalfClose() {
  std::lock_guard lock(pushing_);
  if (audio_ && !audio_->finished()) FinishAudio();
  Apply([](DanceScore& score) {
    return score.timeline().complete() ? DanceEvents() : score.KeysComplete();
  });
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
    HandOutHere();
  } catch (...) {
    mailbox_.GiveUp();
    std::lock_guard lock(mutex_);
    DropJobs();
  }
}

// Jobs and chain keep each other alive. This breaks the cycle.
void DanceChain::DropJobs() {
  if (jobs_.empty()) return;
  for (const std::shared_ptr<Job>& job : jobs_) job->Retire();
  jobs_.clear();
  queue_.CheckCancelled();
}

bool DanceChain::HandOut() {
  return pacer_.Run(
      mutex_, kFramesASlice, [this] { return TakeNext(); },
      [this](std::function<void()> report) {
        if (report) std::exchange(report, {})();  // and frees its captures
        mailbox_.Deliver();                       // the sink may pause the dance
      });
}

void DanceChain::HandOutHere() {
  if (!HandOut()) return;
  double due = 0;
  {
    std::lock_guard lock(mutex_);
    due = start_time_ + Seconds(next_frame_ - first_frame_);
  }
  hand_over_.ToWorker(shared_from_this(), due,
                      [this](std::shared_ptr<SampleJob> job) { queue_.Submit(std::move(job)); });
}

void DanceChain::OnFailure(const Error& failure) noexcept {
  React([&] {
    // After kUnavailable from a closing queue, frames already sampled are still handed out. Other
    // errors come from the sink.
    if (failure.code() != ErrorCode::kUnavailable) mailbox_.PostError(failure);
  });
}

std::function<void()> DanceChain::TakeNext() {
  if (over()) {
    DropJobs();
    return {};
  }
  if (paused_) return {};
  if (jobs_.empty()) {
    if (!score_.timeline().complete() || !score_.EndsBy(next_frame_)) return {};
    return [this, end = next_frame_, controls = score_.controls()] {
      report_.Summarise(end, controls);
    };
  }
  const int64_t ready = Ready();
  score_.TurnWithMusic(jobs_.size(), ready);
  if (score_.Overtakes(next_frame_)) return FinishTransition();
  const std::shared_ptr<Job>& job = jobs_.front();
  if (job->failure()) return [this, failure = *job->failure()] { mailbox_.PostError(failure); };
  if (!job->sampled() || !score_.timeline().IsCertain(next_frame_)) return {};
  if (audio_ && ready <= next_frame_) return {};
  std::optional<Key> key;
  if (next_frame_ + 1 == job->segment().to && job->run().arrival())
    key = score_.Current()->key;  // its hands may have changed since the job was made
  return [this, job, frame = next_frame_++, key = std::move(key)] { Report(*job, frame, key); };
}

std::function<void()> DanceChain::FinishTransition() {
  std::shared_ptr<Job> job = std::move(jobs_.front());
  jobs_.pop_front();
  if (!job->sampled()) {  // a sampled job may be handing out frames right now
    job->Retire();
    queue_.CheckCancelled();
  }
  score_.Finish();
  if (next_frame_ > job->segment().from) danced_ = job->StateBefore(next_frame_);
  // No frame follows the end, so the remaining transitions are not needed.
  if (score_.EndsBy(next_frame_)) DropJobs();
  SubmitNext();
  return [this, job = std::move(job), frame = next_frame_, danced = danced_] {
    if (frame > job->segment().from) report_.End(frame, danced);
  };
}

void DanceChain::Report(const Job& job, int64_t frame, const std::optional<Key>& key) {
  const int64_t from = job.segment().from;
  if (frame == from) {
    report_.Begin(job.segment(), job.warnings(), job.beats());
    // A resumed dance may begin a frame later.
    if (audio_) audio_->Forget(from - model_.history_frames);
  }
  OutputFrames output = output_.Push(job.FrameAt(frame));
  if (!output.poses.empty()) {
    mailbox_.Post([output = std::move(output)](DanceSink& sink) {
      sink.OnFrames(output.first_frame, output.poses, output.contacts);
    });
  }
  report_.Add(frame, job.FrameAt(frame));
  if (key) report_.Reach(*key, *job.run().arrival());
}

void DanceChain::SubmitNext() {
  if (over() || cancelled_ || jobs_.size() > kMaxAhead) return;
  if (!jobs_.empty() && !jobs_.back()->sampled()) return;  // the next start is not known yet
  std::optional<DanceScore::Next> next = score_.TakeNext(jobs_.size(), Ready());
  if (!next) return;
  const int64_t from = next->inputs.segment.from;
  next->inputs.before = jobs_.empty() ? danced_ : jobs_.back()->StateBefore(from);
  // A dance that waited for its client's messages is due from now on. With its old start time it
  // would overtake dances that did not wait.
  start_time_ = std::max(start_time_, PlaybackClock() - Seconds(from - first_frame_));
  auto job = std::make_shared<Job>(shared_from_this(), *std::move(next));
  try {
    queue_.Submit(job);
  } catch (const Error& error) {
    job->Fail(error);
  }
  jobs_.push_back(std::move(job));  // its reports block on mutex_
}

}  // namespace choreo
