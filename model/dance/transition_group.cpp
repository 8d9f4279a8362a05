#include "model/dance/transition_group.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "model/core/error.h"
#include "model/dance/body_watch.h"
#include "model/dance/dance_music.h"
#include "model/dance/dance_report.h"
#include "model/dance/mailbox.h"
#include "model/dance/output_rate.h"
#include "model/dance/recurrence.h"
#include "model/dance/transition.h"

namespace choreo {

class TransitionGroup::Impl : public std::enable_shared_from_this<TransitionGroup::Impl> {
 public:
  Impl(SampleQueue& queue, GroupRequest request, std::shared_ptr<GroupSink> sink);

  void Begin();
  void SetPaused(bool paused);
  void Cancel() noexcept;

 private:
  class Job;

  void Warn(const Warning& warning) {
    mailbox_.Post([warning](GroupSink& sink) { sink.OnWarning(warning); });
  }

  void Done(CandidateReport report);
  std::vector<std::shared_ptr<Job>> TakeJobs();

  SampleQueue& queue_;
  const SampleQueue::Reservation room_;
  const ModelInfo& model_;
  const int64_t first_frame_;
  GroupRequest request_;  // its samples are freed once their features are known
  std::unique_ptr<AudioFeed> audio_;
  ControlTrack controls_;
  Mailbox<GroupSink> mailbox_;
  std::atomic<bool> cancelled_ = false;
  std::atomic<bool> paused_ = false;

  std::mutex mutex_;                        // guards the members below
  std::vector<std::shared_ptr<Job>> jobs_;  // until all are done or cancelled
  std::vector<CandidateReport> reports_;
};

class TransitionGroup::Impl::Job : public SampleJob,
                                   public std::enable_shared_from_this<TransitionGroup::Impl::Job> {
 public:
  Job(std::shared_ptr<Impl> group, TransitionRun run)
      : group_(std::move(group)),
        run_(std::move(run)),
        meter_(group_->model_.skeleton, group_->model_.fps, group_->first_frame_),
        watch_(group_->model_.skeleton, group_->model_.fps, run_.StateAfter(0).history.back()),
        output_(group_->model_.fps, group_->request_.output_fps, group_->first_frame_,
                run_.StateAfter(0).history.back()) {
    watch_.Begin(group_->request_.target ? group_->request_.target_id : "", frames());
  }

  bool Continue(Sampler& sampler) override {
    if (!slices_) slices_.emplace(Work(sampler));
    return slices_->Continue();
  }

  void OnDone(const Error* failure) noexcept override {
    if (failure != nullptr) OnFailure(*failure);
  }
  void OnFailure(const Error& failure) noexcept {
    try {
      group_->mailbox_.PostError(failure);
      group_->mailbox_.Deliver();
    } catch (...) {
      group_->mailbox_.GiveUp();
    }
    group_->Cancel();  // a ranking that lacks a candidate is worthless
  }

  double Deadline() const override { return deadline_; }
  int frames() const override { return run_.spec().frames; }
  bool Cancelled() const override { return group_->cancelled_; }

  /// Hands out a few frames once they are sampled, unless the group is paused. Returns true if
  /// there may be more.
  bool HandOut() {
    return pacer_.Run(
        mutex_, kFramesASlice, [this] { return TakeNext(); },
        [this](const DanceFrame* frame) {
          if (frame != nullptr) Report(*frame);
          group_->mailbox_.Deliver();  // the sink may pause the group
        });
  }

  /// Lets a worker continue after a pause.
  void Resume() {
    {
      std::lock_guard lock(mutex_);
      if (!is_sampled_ || handed_out_ == frames()) return;
    }
    hand_over_.ToWorker(shared_from_this(), deadline_, [this](std::shared_ptr<SampleJob> job) {
      group_->queue_.SubmitBulk(std::move(job));
    });
  }

  HandOver<Job>& hand_over() { return hand_over_; }

 private:
  Slices<> Work(Sampler& sampler) {
    co_await run_.Dance(sampler);
    is_sampled_ = true;
    do {
      co_await Pause();
    } while (HandOut());
  }

  // Requires mutex_. Returns null if nothing may be handed out.
  const DanceFrame* TakeNext() {
    if (!is_sampled_ || group_->paused_ || group_->cancelled_ || handed_out_ == frames())
      return nullptr;
    return &run_.frames()[static_cast<size_t>(handed_out_++)];
  }

  void Report(const DanceFrame& frame) {
    const int64_t number = run_.spec().first_frame + (&frame - run_.frames().data());
    const bool is_last = &frame == &run_.frames().back();
    meter_.Add(frame);
    watch_.Add(number, frame.pose);
    if (is_last && run_.arrival()) {
      KeyReached reached = *run_.arrival();
      reached.id = group_->request_.target_id;
      meter_.AddKey(std::move(reached));
    }
    OutputFrames output = output_.Push(frame);
    if (!output.poses.empty()) {
      group_->mailbox_.Post([candidate = Number(), output = std::move(output)](GroupSink& sink) {
        sink.OnFrames(candidate, output.first_frame, output.poses, output.contacts);
      });
    }
    if (!is_last) return;
    const GroupRequest& request = group_->request_;
    const double strain = Judge();
    group_->Done({Number(), meter_.Report(request.music_beats),
                  ContinuationAt(number + 1, run_.StateAfter(run_.frames().size()), group_->model_,
                                 request, /*hears_beats=*/false),
                  strain});
  }

  int Number() const { return static_cast<int>(run_.spec().candidate); }

  // Warns about motion beyond the limits of human bodies in this candidate. Returns
  // CandidateReport::strain.
  double Judge() {
    double strain = 0;
    for (Warning& warning : watch_.Take()) {
      strain = std::max(strain, warning.figure / warning.limit);
      if (group_->request_.candidates > 1)
        warning.message = "candidate " + std::to_string(Number()) + ": " + warning.message;
      group_->Warn(warning);
    }
    return strain;
  }

  const std::shared_ptr<Impl> group_;
  const double deadline_ = PlaybackClock();
  TransitionRun run_;               // used by the worker until sampled
  std::optional<Slices<>> slices_;  // the worker's
  std::atomic<bool> is_sampled_ = false;

  std::mutex mutex_;  // guards the next two members
  Pacer pacer_;
  int handed_out_ = 0;
  HandOver<Job> hand_over_;
  // Only the thread that hands out uses the members below.
  QualityMeter meter_;
  BodyWatch watch_;
  OutputRate output_;
};

TransitionGroup::Impl::Impl(SampleQueue& queue, GroupRequest request,
                            std::shared_ptr<GroupSink> sink)
    : queue_(queue),
      room_(queue.ReserveBulk(request.candidates)),  // before any work that a refusal would waste
      model_(queue.model()),
      first_frame_(request.FirstFrame()),
      request_(std::move(request)),
      controls_(model_),
      mailbox_(std::move(sink)) {
  if (!request_.audio) return;
  // Keeps only the part of a long song that the transition hears.
  const std::vector<float> samples = std::exchange(request_.samples, {});
  const auto& [rate, channel_count, first_sample] = *request_.audio;
  const int64_t first = ResumeSample(request_, first_frame_, model_, /*beats=*/false);
  const size_t channels = static_cast<size_t>(channel_count);
  const size_t skipped =
      std::min(static_cast<size_t>(first - first_sample) * channels, samples.size());
  std::span<const float> rest = std::span(samples).subspan(skipped);
  audio_ = std::make_unique<AudioFeed>(
      rate, channel_count, first_sample + static_cast<int64_t>(skipped / channels), model_.hearing);
  const size_t second = static_cast<size_t>(rate) * channels;
  while (!rest.empty() && audio_->ready() < first_frame_ + request_.frames) {
    const size_t count = std::min(second, rest.size());
    audio_->Push(rest.first(count), audio_->next_sample(), [] {});
    rest = rest.subspan(count);
  }
  if (rest.empty()) audio_->Finish();
}

void TransitionGroup::Impl::Begin() {
  const auto changes = controls_.Set(request_.controls, first_frame_, "controls");
  const int64_t end = first_frame_ + request_.frames;
  Segment segment{first_frame_, end, std::nullopt};
  if (const auto& target = request_.target)
    segment.key = Key{request_.target_id, end - 1, target->pose, target->mask, request_.hit};
  // All candidates have the same request, so it is checked once and its warnings are sent once.
  DanceMusic music(model_, request_, audio_.get(), /*detects=*/false);
  auto [run, warnings] = PrepareTransition(
      model_,
      {.manner = request_,
       .seed = request_.seed,
       .controls = controls_,
       .segment = segment,
       .before = {request_.Before(),
                  request_.continuation ? request_.continuation->stage : std::nullopt},
       .after = request_.after,
       .noise_like =
           Recurrence(model_.fps, request_.music_passages).Origins(segment.from, segment.to),
       .music = music.PlanFor(segment, end).Hear()});
  for (const Warning& warning : controls_.BehindEnd(end)) warnings.push_back(warning);
  for (const auto& [label, changed] : changes) {
    if (changed.last < first_frame_)
      warnings.push_back(ControlsTooLate(label, changed.last, first_frame_));
  }
  for (const Warning& warning : request_.Warnings(model_)) Warn(warning);
  for (const Warning& warning : warnings) Warn(warning);
  std::vector<std::shared_ptr<Job>> jobs;
  for (int candidate = 0; candidate < request_.candidates; ++candidate) {
    run.set_candidate(static_cast<uint32_t>(candidate));
    jobs.push_back(std::make_shared<Job>(shared_from_this(), run));
  }
  {
    std::lock_guard lock(mutex_);
    jobs_ = jobs;
  }
  try {
    for (auto& job : jobs) queue_.SubmitBulk(std::move(job));
  } catch (...) {
    mailbox_.PostLast([](GroupSink&) {});  // the caller gets the exception; the sink gets no call
    Cancel();
    throw;
  }
  mailbox_.Deliver();
}

std::vector<std::shared_ptr<TransitionGroup::Impl::Job>> TransitionGroup::Impl::TakeJobs() {
  std::lock_guard lock(mutex_);
  return std::exchange(jobs_, {});
}

void TransitionGroup::Impl::SetPaused(bool paused) {
  paused_ = paused;
  if (paused) return;
  std::vector<std::shared_ptr<Job>> jobs;
  {
    std::lock_guard lock(mutex_);
    jobs = jobs_;
  }
  for (const auto& job : jobs) job->Resume();
}

void TransitionGroup::Impl::Cancel() noexcept {
  if (cancelled_.exchange(true)) return;
  queue_.CheckCancelled();
  try {
    mailbox_.PostError(Error(ErrorCode::kCancelled, "", "cancelled"));
    mailbox_.Deliver();
  } catch (...) {
    mailbox_.GiveUp();
  }
  TakeJobs();
}

void TransitionGroup::Impl::Done(CandidateReport report) {
  std::vector<std::shared_ptr<Job>> done;  // destroyed after the lock is released
  std::lock_guard lock(mutex_);
  reports_.push_back(std::move(report));
  if (std::ssize(reports_) < request_.candidates) return;
  done.swap(jobs_);
  RankCandidates(reports_, request_.rank_by);
  for (const Warning& warning : controls_.Missed(reports_.front().quality)) Warn(warning);
  mailbox_.PostLast([ranked = reports_](GroupSink& sink) { sink.OnDone(ranked); });
}

TransitionGroup::TransitionGroup(SampleQueue& queue, ValidGroup request,
                                 std::shared_ptr<GroupSink> sink) {
  impl_ = std::make_shared<Impl>(queue, *std::move(request), std::move(sink));
  impl_->Begin();
}

TransitionGroup::~TransitionGroup() { impl_->Cancel(); }

void TransitionGroup::SetPaused(bool paused) { impl_->SetPaused(paused); }
void TransitionGroup::Cancel() noexcept { impl_->Cancel(); }

}  // namespace choreo
