#include "model/dance/transition_group.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <tuple>
#include <utility>

#include "model/core/error.h"
#include "model/dance/ask_transition.h"
#include "model/dance/mailbox.h"
#include "model/dance/output_rate.h"
#include "model/dance/scheduled_transition.h"

namespace choreo {
namespace {

double KeyError(const CandidateReport& report) {
  return report.quality.keys.empty() ? 0 : report.quality.keys.front().arrival.raw_error_m;
}

}  // namespace

void RankCandidates(std::vector<CandidateReport>& candidates) {
  constexpr double kErrorStep = 0.01;  // metres
  constexpr double kSkateStep = 0.01;
  const auto rank = [](const CandidateReport& report) {
    return std::tuple(std::floor(KeyError(report) / kErrorStep),
                      std::floor(report.quality.skate_ratio / kSkateStep),
                      -report.quality.mean_log_likelihood, report.candidate);
  };
  std::sort(candidates.begin(), candidates.end(),
            [&rank](const auto& a, const auto& b) { return rank(a) < rank(b); });
}

class TransitionGroup::Impl : public std::enable_shared_from_this<TransitionGroup::Impl> {
 public:
  Impl(Scheduler& scheduler, const GroupRequest& request, std::shared_ptr<GroupSink> sink);

  void Begin();
  void SetPaused(bool paused);
  void Cancel() noexcept;

 private:
  class Job;

  // When something failed that would have told the sink what failed.
  void GiveUp() noexcept;
  void Warn(const DanceWarning& warning) {
    mailbox_.Post([warning](GroupSink& sink) { sink.OnWarning(warning); });
  }

  // With mutex_ held.
  void Done(CandidateReport report);
  void Fail(const Error& error);
  void WakeAll();

  Scheduler& scheduler_;
  const ModelInfo& model_;
  const int64_t first_frame_;
  const GroupRequest request_;  // without its samples
  std::optional<AudioFeed> audio_;
  ControlTrack controls_;
  Mailbox<GroupSink> mailbox_;
  std::atomic<bool> cancelled_ = false;
  std::atomic<bool> paused_ = true;  // until all candidates are accepted

  std::mutex mutex_;        // of what follows
  std::vector<Job*> jobs_;  // by candidate; null: done. The scheduler keeps the others alive
  int running_ = 0;
  bool over_ = false;  // the last call to the sink is posted
  std::vector<CandidateReport> reports_;
};

class TransitionGroup::Impl::Job : public ScheduledTransition {
 public:
  Job(std::shared_ptr<Impl> group, int candidate, const TransitionRequest& request)
      : ScheduledTransition(group->model_, request, group->audio_ ? &*group->audio_ : nullptr),
        group_(std::move(group)),
        candidate_(candidate),
        history_(request.history),
        meter_(group_->model_.skeleton, group_->model_.fps, group_->first_frame_),
        output_(group_->model_.fps, group_->request_.output_fps, group_->first_frame_,
                history_.back()),
        start_time_(PlaybackClock()) {}

  bool NextInput(StepInput* input) override {
    if (!Ready()) return false;
    FillInput(input);
    return true;
  }

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
      {
        std::lock_guard lock(group_->mutex_);
        group_->jobs_[static_cast<size_t>(candidate_)] = nullptr;
        if (failure != nullptr) {
          group_->Fail(*failure);
        } else {
          group_->Done({candidate_, Quality(), GoesOn()});
        }
      }
      group_->mailbox_.Deliver();
    } catch (...) {
      group_->GiveUp();
    }
  }

  double NextDeadline() const override { return start_time_ + danced() / group_->model_.fps; }

  bool Cancelled() const override { return group_->cancelled_; }

 private:
  Continuation GoesOn() const {
    Continuation end{NextFrame(), history_, group_->model_.fingerprint};
    end.stage = run().stage();
    if (const auto& audio = group_->request_.audio)
      end.audio_from_sample = LatestFirstSample(end.frame, audio->sample_rate, group_->model_);
    return end;
  }

  QualityReport Quality() const {
    std::vector<double> beats;
    for (double seconds : group_->request_.music_beats) {
      beats.push_back(seconds * group_->model_.fps);
    }
    return meter_.Report(beats);
  }

  const std::shared_ptr<Impl> group_;
  const int candidate_;
  std::vector<Pose> history_;
  QualityMeter meter_;
  OutputRate output_;
  const double start_time_;
};

TransitionGroup::Impl::Impl(Scheduler& scheduler, const GroupRequest& request,
                            std::shared_ptr<GroupSink> sink)
    : scheduler_(scheduler),
      model_(scheduler.model()),
      first_frame_(request.FirstFrame()),
      request_([&request] {
        GroupRequest rest = request;
        rest.samples.clear();
        rest.samples.shrink_to_fit();
        return rest;
      }()),
      controls_(model_),
      mailbox_(std::move(sink)) {
  if (!request.audio) return;
  // Of a long song only what the transition hears.
  const auto& [rate, channel_count, first_sample] = *request.audio;
  const int64_t first = LatestFirstSample(first_frame_, rate, model_);
  const size_t channels = static_cast<size_t>(channel_count);
  const size_t skipped =
      std::min(static_cast<size_t>(first - first_sample) * channels, request.samples.size());
  std::span<const float> rest = std::span(request.samples).subspan(skipped);
  audio_.emplace(rate, channel_count, first_sample + static_cast<int64_t>(skipped / channels));
  const size_t second = static_cast<size_t>(rate) * channels;
  while (!rest.empty() && audio_->ready() < first_frame_ + request.frames) {
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
  AskedTransition asked = AskTransition(request_, model_, controls_, audio_ ? &*audio_ : nullptr,
                                        segment, request_.Before());
  TransitionRequest& transition = asked.request;
  transition.after = request_.after;
  transition.beats = BeatsAround(request_.music_beats, model_.fps, first_frame_, request_.frames);
  if (request_.continuation) transition.stage = request_.continuation->stage;

  std::vector<std::shared_ptr<Job>> jobs;
  for (int candidate = 0; candidate < request_.candidates; ++candidate) {
    transition.candidate = static_cast<uint32_t>(candidate);
    jobs.push_back(std::make_shared<Job>(shared_from_this(), candidate, transition));
  }
  for (const DanceWarning& warning : request_.Warnings(model_, first_frame_)) Warn(warning);
  for (const DanceWarning& warning : asked.warnings) Warn(warning);
  if (const auto warning = controls_.BehindEnd(end)) Warn(*warning);
  const auto& path = request_.controls.root_path;
  if (path && path->frames.back() < first_frame_)
    Warn(ControlsTooLate(path->frames.back(), first_frame_));
  const std::optional<RequiredSpeed> speed = jobs.front()->run().required_speed();
  if (speed && speed->TooFast()) {
    Warn(IntervalTooShort(model_.skeleton, request_.target_id, first_frame_, request_.frames,
                          *speed));
  }
  {
    std::lock_guard lock(mutex_);
    jobs_.resize(jobs.size());
    running_ = static_cast<int>(jobs.size());
    for (size_t i = 0; i < jobs.size(); ++i) jobs_[i] = jobs[i].get();
    try {
      scheduler_.SubmitGroup({jobs.begin(), jobs.end()});
    } catch (...) {
      over_ = true;  // the caller hears of it; the sink stays silent
      cancelled_ = true;
      throw;
    }
    paused_ = false;
    WakeAll();
  }
  mailbox_.Deliver();
}

void TransitionGroup::Impl::WakeAll() {
  for (Job* job : jobs_) {
    if (job != nullptr) scheduler_.Wake(job);
  }
}

void TransitionGroup::Impl::SetPaused(bool paused) {
  paused_ = paused;
  if (paused) return;
  std::lock_guard lock(mutex_);
  WakeAll();
}

void TransitionGroup::Impl::Cancel() noexcept {
  cancelled_ = true;
  std::lock_guard lock(mutex_);
  WakeAll();
}

void TransitionGroup::Impl::GiveUp() noexcept {
  {
    std::lock_guard lock(mutex_);
    over_ = true;
  }
  mailbox_.GiveUp();
  Cancel();
}

void TransitionGroup::Impl::Done(CandidateReport report) {
  reports_.push_back(std::move(report));
  if (over_ || --running_ > 0) return;
  over_ = true;
  RankCandidates(reports_);
  if (const auto warning = controls_.SpeedsMissed(reports_.front().quality)) Warn(*warning);
  mailbox_.Post([ranked = reports_](GroupSink& sink) { sink.OnDone(ranked); });
}

void TransitionGroup::Impl::Fail(const Error& error) {
  if (over_) return;
  over_ = true;
  mailbox_.Post([error](GroupSink& sink) { sink.OnError(error); });
  // One candidate short the ranking means nothing: the others end too.
  cancelled_ = true;
  WakeAll();
}

TransitionGroup::TransitionGroup(Scheduler& scheduler, const GroupRequest& request,
                                 std::shared_ptr<GroupSink> sink) {
  request.Validate(scheduler.model());
  impl_ = std::make_shared<Impl>(scheduler, request, std::move(sink));
  impl_->Begin();
}

TransitionGroup::~TransitionGroup() { impl_->Cancel(); }

void TransitionGroup::SetPaused(bool paused) { impl_->SetPaused(paused); }
void TransitionGroup::Cancel() noexcept { impl_->Cancel(); }

}  // namespace choreo
