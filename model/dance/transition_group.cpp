#include "model/dance/transition_group.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <tuple>
#include <utility>

#include "model/core/error.h"
#include "model/dance/mailbox.h"
#include "model/dance/output_rate.h"
#include "model/dance/scheduled_transition.h"

namespace choreo {

void RankCandidates(std::vector<CandidateReport>& candidates) {
  constexpr double kSteeredStep = 0.01;  // metres
  constexpr double kSkateStep = 0.01;
  constexpr double kSupportStep = 0.05;  // three frames of two seconds
  std::ranges::sort(candidates, {}, [](const CandidateReport& report) {
    const QualityReport& quality = report.quality;
    const double steered = quality.keys.empty() ? 0 : quality.keys.front().arrival.correction_m;
    const double unsupported = 1 - quality.support.value_or(1);
    return std::tuple(std::floor(steered / kSteeredStep), std::floor(unsupported / kSupportStep),
                      std::floor(quality.skate_ratio / kSkateStep),
                      -quality.mean_log_likelihood.value_or(0), report.candidate);
  });
}

class TransitionGroup::Impl : public std::enable_shared_from_this<TransitionGroup::Impl> {
 public:
  Impl(Scheduler& scheduler, GroupRequest request, std::shared_ptr<GroupSink> sink);

  void Begin();
  void SetPaused(bool paused);
  void Cancel() noexcept;

 private:
  class Job;

  void Warn(const DanceWarning& warning) {
    mailbox_.Post([warning](GroupSink& sink) { sink.OnWarning(warning); });
  }

  void Done(CandidateReport report);
  void WakeAll();

  Scheduler& scheduler_;
  const ModelInfo& model_;
  const int64_t first_frame_;
  GroupRequest request_;  // without its samples, once they are heard
  std::unique_ptr<AudioFeed> audio_;
  ControlTrack controls_;
  Mailbox<GroupSink> mailbox_;
  std::atomic<bool> cancelled_ = false;
  std::atomic<bool> paused_ = false;
  std::vector<const Job*> jobs_;  // constant once they are submitted; the scheduler owns them

  std::mutex mutex_;  // of what follows
  std::vector<CandidateReport> reports_;
};

class TransitionGroup::Impl::Job : public ScheduledTransition {
 public:
  // All candidates ask for the same: what is wrong with it, or worth a warning, the first one says.
  Job(std::shared_ptr<Impl> group, const AskedTransition& asked)
      : ScheduledTransition(group->model_, asked, group->audio_.get(), PlaybackClock(),
                            asked.request.candidate == 0 ? Begins::kAtOnce : Begins::kLate),
        group_(std::move(group)),
        candidate_(static_cast<int>(asked.request.candidate)),
        history_(asked.request.history),
        meter_(group_->model_.skeleton, group_->model_.fps, group_->first_frame_),
        output_(group_->model_.fps, group_->request_.output_fps, group_->first_frame_,
                history_.back()) {}

  bool Ready() const override { return !group_->paused_; }

  bool OnFrame(const StepOutput& raw) override {
    const std::optional<DanceFrame> frame = TakeNew(raw);
    if (!frame) return true;
    meter_.Add(*frame);
    MoveOn(frame->pose, &history_);
    if (run().arrival()) meter_.AddKey(group_->request_.target_id, *run().arrival());
    OutputFrames frames = output_.Push(*frame);
    if (!frames.poses.empty()) {
      group_->mailbox_.Post([candidate = candidate_, frames = std::move(frames)](GroupSink& sink) {
        sink.OnFrames(candidate, frames.first_frame, frames.poses, frames.contacts);
      });
      group_->mailbox_.Deliver();
    }
    return run().done() < run().frames();
  }

  void OnDone(const Error* failure) noexcept override {
    try {
      if (failure == nullptr) {
        group_->Done({candidate_, meter_.Report(group_->request_.music_beats), GoesOn()});
      } else {
        group_->mailbox_.PostError(*failure);
        group_->Cancel();  // one candidate short the ranking means nothing
      }
      group_->mailbox_.Deliver();
    } catch (...) {
      group_->mailbox_.GiveUp();
      group_->Cancel();
    }
  }

  bool Cancelled() const override { return group_->cancelled_; }

 private:
  Continuation GoesOn() const {
    Continuation end{NextFrame(), history_, group_->model_.fingerprint};
    end.stage = run().stage();
    if (const auto& audio = group_->request_.audio)
      end.audio_from_sample = LatestFirstSample(end.frame, audio->sample_rate, group_->model_);
    return end;
  }

  const std::shared_ptr<Impl> group_;
  const int candidate_;
  std::vector<Pose> history_;
  QualityMeter meter_;
  OutputRate output_;
};

TransitionGroup::Impl::Impl(Scheduler& scheduler, GroupRequest request,
                            std::shared_ptr<GroupSink> sink)
    : scheduler_(scheduler),
      model_(scheduler.model()),
      first_frame_(request.FirstFrame()),
      request_(std::move(request)),
      controls_(model_),
      mailbox_(std::move(sink)) {
  if (!request_.audio) return;
  // Of a long song only what the transition hears.
  const std::vector<float> samples = std::exchange(request_.samples, {});
  const auto& [rate, channel_count, first_sample] = *request_.audio;
  const int64_t first = LatestFirstSample(first_frame_, rate, model_);
  const size_t channels = static_cast<size_t>(channel_count);
  const size_t skipped =
      std::min(static_cast<size_t>(first - first_sample) * channels, samples.size());
  std::span<const float> rest = std::span(samples).subspan(skipped);
  audio_ = std::make_unique<AudioFeed>(rate, channel_count,
                                       first_sample + static_cast<int64_t>(skipped / channels));
  const size_t second = static_cast<size_t>(rate) * channels;
  while (!rest.empty() && audio_->ready() < first_frame_ + request_.frames) {
    const size_t count = std::min(second, rest.size());
    audio_->Push(rest.first(count), audio_->next_sample(), [] {});
    rest = rest.subspan(count);
  }
  if (rest.empty()) audio_->Finish();
}

void TransitionGroup::Impl::Begin() {
  controls_.Set(request_.controls, first_frame_, "controls");
  const int64_t end = first_frame_ + request_.frames;
  Segment segment{first_frame_, end, std::nullopt};
  if (const auto& target = request_.target)
    segment.key = Key{request_.target_id, end - 1, target->pose, target->mask};
  AskedTransition asked =
      AskTransition(request_, model_, controls_, audio_.get(), segment, request_.Before());
  TransitionRequest& transition = asked.request;
  transition.after = request_.after;
  transition.beats = BeatsAround(request_.music_beats, model_.fps, first_frame_, request_.frames);
  if (request_.continuation) transition.stage = request_.continuation->stage;
  if (const auto warning = controls_.BehindEnd(end)) asked.warnings.push_back(*warning);
  const auto& path = request_.controls.root_path;
  if (path && path->frames.back() < first_frame_)
    asked.warnings.push_back(ControlsTooLate(path->frames.back(), first_frame_));

  std::vector<std::shared_ptr<Job>> jobs;
  for (int candidate = 0; candidate < request_.candidates; ++candidate) {
    transition.candidate = static_cast<uint32_t>(candidate);
    jobs.push_back(std::make_shared<Job>(shared_from_this(), asked));
  }
  for (const DanceWarning& warning : request_.Warnings(model_, first_frame_)) Warn(warning);
  for (const DanceWarning& warning : jobs.front()->warnings()) Warn(warning);
  for (const auto& job : jobs) jobs_.push_back(job.get());
  try {
    scheduler_.SubmitGroup({jobs.begin(), jobs.end()});
  } catch (...) {
    cancelled_ = true;
    mailbox_.PostLast([](GroupSink&) {});  // the caller hears of it; the sink stays silent
    throw;
  }
  mailbox_.Deliver();
}

void TransitionGroup::Impl::WakeAll() {
  for (const Job* job : jobs_) scheduler_.Wake(job);
}

void TransitionGroup::Impl::SetPaused(bool paused) {
  paused_ = paused;
  if (!paused) WakeAll();
}

void TransitionGroup::Impl::Cancel() noexcept {
  if (!cancelled_.exchange(true)) WakeAll();  // each job that ends so cancels the group again
}

void TransitionGroup::Impl::Done(CandidateReport report) {
  std::lock_guard lock(mutex_);
  reports_.push_back(std::move(report));
  if (reports_.size() < jobs_.size()) return;
  RankCandidates(reports_);
  if (const auto warning = controls_.SpeedsMissed(reports_.front().quality)) Warn(*warning);
  mailbox_.PostLast([ranked = reports_](GroupSink& sink) { sink.OnDone(ranked); });
}

TransitionGroup::TransitionGroup(Scheduler& scheduler, GroupRequest request,
                                 std::shared_ptr<GroupSink> sink) {
  request.Validate(scheduler.model());
  impl_ = std::make_shared<Impl>(scheduler, std::move(request), std::move(sink));
  impl_->Begin();
}

TransitionGroup::~TransitionGroup() { impl_->Cancel(); }

void TransitionGroup::SetPaused(bool paused) { impl_->SetPaused(paused); }
void TransitionGroup::Cancel() noexcept { impl_->Cancel(); }

}  // namespace choreo
