#include "model/dance/dance_chain.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/dance/transition/transition.h"

namespace choreo {
namespace {

constexpr size_t kMaxAhead = 1;  // transitions sampled ahead of the one being handed out

}  // namespace

/// One transition of the chain, from its submission until its last frame is handed out.
class DanceChain::Transition : public Job {
 public:
  Transition(std::shared_ptr<DanceChain> chain, TransitionInputs inputs)
      : Job(chain, static_cast<int>(inputs.segment.to - inputs.segment.from),
            chain->start_time_ + chain->Seconds(inputs.segment.from - chain->first_frame_)),
        chain_(*chain),
        segment_(inputs.segment),
        inputs_(std::move(inputs)) {}

  void OnDone(const Error* failure) noexcept override {
    if (failure == nullptr || retired_) return;
    if (sampled_) return chain_.OnFailure(*failure);
    chain_.React([this, failure] { Fail(*failure); });
  }

  bool Cancelled() const override { return retired_ || Job::Cancelled(); }

  /// Cancels a transition that the chain no longer needs; the queue drops it.
  void Retire() { retired_ = true; }
  /// The failure is reported once all frames before the transition are handed out.
  void Fail(const Error& failure) {
    Stop();
    failure_ = failure;
  }

  bool sampled() const { return sampled_; }
  const std::optional<Error>& failure() const { return failure_; }
  const Segment& segment() const { return segment_; }

  /// Constant once sampled.
  const std::vector<Warning>& warnings() const { return warnings_; }
  const std::vector<Beat>& beats() const { return beats_; }
  const DanceFrame& FrameAt(int64_t frame) const {
    return run().frames()[static_cast<size_t>(frame - segment_.from)];
  }
  /// The state from which a transition that begins at `frame` starts. `frame` is in this transition
  /// or directly after it.
  DancedState StateBefore(int64_t frame) const {
    return run().StateAfter(static_cast<size_t>(frame - segment_.from));
  }

 private:
  TransitionRun Prepare() override {
    const TransitionInputs inputs = *std::exchange(inputs_, {});
    PreparedTransition prepared = PrepareTransition(chain_.model_, inputs);
    beats_ = std::move(prepared.beats);
    warnings_ = std::move(prepared.warnings);
    return std::move(prepared.run);
  }

  Slices<> Finish() override {
    std::lock_guard lock(chain_.mutex_);
    sampled_ = true;
    chain_.Proceed();
    co_return;
  }

  DanceChain& chain_;  // kept alive by Job
  const Segment segment_;
  std::optional<TransitionInputs> inputs_;  // until the transition is prepared
  std::vector<Beat> beats_;
  std::vector<Warning> warnings_;
  std::atomic<bool> sampled_ = false;
  std::optional<Error> failure_;  // guarded by the chain's mutex
  std::atomic<bool> retired_ = false;
};

DanceChain::DanceChain(SampleQueue& queue, const ValidDance& config,
                       std::shared_ptr<DanceSink> sink)
    : Delivery(queue, &SampleQueue::Submit, std::move(sink)),
      manner_(*config),
      seed_(config->seed),
      first_frame_(config->FirstFrame()),
      audio_(config->audio
                 ? std::make_unique<AudioFeed>(config->audio->sample_rate, config->audio->channels,
                                               config->audio->first_sample, model_.music_features)
                 : nullptr),
      reporter_(model_, config, audio_.get(), mailbox_),
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
  Change([&] {
    if (over()) return;
    for (const DanceEvent& event : change(score_)) PostEvent(mailbox_, event);
  });
}

void DanceChain::PushAudio(std::span<const float> interleaved, int64_t first_sample) {
  std::lock_guard lock(pushing_);
  AudioFeed& audio = Audio("push_audio");
  if (!over()) audio.Push(interleaved, first_sample, [this] { Continue(); });
}

void DanceChain::FinishAudio() {
  AudioFeed& audio = Audio("end_of_audio");
  if (audio.finished()) throw Error(ErrorCode::kFailedPrecondition, "end_of_audio", "came before");
  if (audio.next_sample() == 0) throw InvalidArgument("end_of_audio", "no sample came before");
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

// Jobs and chain keep each other alive. This breaks the cycle.
void DanceChain::Drop() {
  if (jobs_.empty()) return;
  for (const std::shared_ptr<Transition>& job : jobs_) job->Retire();
  jobs_.clear();
  queue_.CheckCancelled();
}

std::function<void()> DanceChain::TakeNext() {
  if (jobs_.empty()) {
    if (!score_.timeline().complete() || !score_.EndsBy(next_frame_)) return {};
    return [this, end = next_frame_, controls = score_.controls()] {
      reporter_.Summarise(end, controls);
    };
  }
  const int64_t ready = Ready();
  score_.TurnWithMusic(jobs_.size(), ready);
  if (score_.Overtakes(next_frame_)) return FinishTransition();
  const std::shared_ptr<Transition>& job = jobs_.front();
  if (job->failure()) return [this, failure = *job->failure()] { mailbox_.PostError(failure); };
  if (!job->sampled() || !score_.timeline().IsCertain(next_frame_)) return {};
  if (audio_ && ready <= next_frame_) return {};
  std::optional<Key> key;
  if (next_frame_ + 1 == job->segment().to && job->run().arrival())
    key = score_.Current()->key;  // its hands may have changed since the job was made
  return [this, job, frame = next_frame_++, key = std::move(key)] { PostFrame(*job, frame, key); };
}

std::function<void()> DanceChain::FinishTransition() {
  std::shared_ptr<Transition> job = std::move(jobs_.front());
  jobs_.pop_front();
  if (!job->sampled()) {  // a sampled job may be handing out frames right now
    job->Retire();
    queue_.CheckCancelled();
  }
  score_.Finish();
  if (next_frame_ > job->segment().from) danced_ = job->StateBefore(next_frame_);
  // No frame follows the end, so the remaining transitions are not needed.
  if (score_.EndsBy(next_frame_)) Drop();
  Proceed();
  return [this, job = std::move(job), frame = next_frame_, danced = danced_] {
    if (frame > job->segment().from) reporter_.End(frame, danced);
  };
}

void DanceChain::PostFrame(const Transition& job, int64_t frame, const std::optional<Key>& key) {
  const int64_t from = job.segment().from;
  if (frame == from) {
    reporter_.StartTransition(job.segment(), job.warnings(), job.beats());
    // A resumed dance may begin a frame later.
    if (audio_) audio_->Forget(from - model_.history_frames);
  }
  reporter_.Add(frame, job.FrameAt(frame));
  if (key) reporter_.AddKey(*key, *job.run().arrival());
}

void DanceChain::Proceed() {
  if (over() || cancelled_ || jobs_.size() > kMaxAhead) return;
  if (!jobs_.empty() && !jobs_.back()->sampled()) return;  // the next start is not known yet
  std::optional<DanceScore::Next> next = score_.TakeNext(jobs_.size(), Ready());
  if (!next) return;
  const int64_t from = next->segment.from;
  TransitionInputs inputs{.spec = SpecOf(model_, manner_, seed_,
                                         jobs_.empty() ? danced_ : jobs_.back()->StateBefore(from)),
                          .controls = score_.controls(),
                          .segment = std::move(next->segment),
                          .music = std::move(next->music)};
  inputs.spec.noise_like = std::move(next->noise_like);
  // A dance that waited for its client's messages is due from now on. With its old start time it
  // would overtake dances that did not wait.
  start_time_ = std::max(start_time_, PlaybackClock() - Seconds(from - first_frame_));
  auto job = std::make_shared<Transition>(std::static_pointer_cast<DanceChain>(shared_from_this()),
                                          std::move(inputs));
  try {
    queue_.Submit(job);
  } catch (const Error& error) {
    job->Fail(error);
  }
  jobs_.push_back(std::move(job));  // its reports block on mutex_
}

}  // namespace choreo
