#include "model/dance/transition_group.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <tuple>
#include <utility>

#include "model/core/error.h"
#include "model/dance/delivery/dance_meter.h"
#include "model/dance/delivery/delivery.h"
#include "model/dance/input/dance_music.h"
#include "model/dance/input/recurrence.h"
#include "model/dance/transition/transition.h"

namespace choreo {

namespace {

// Feeds the samples of the request, and frees them. Keeps only the part of a long song that the
// transition hears. Null without music.
std::unique_ptr<AudioFeed> Feed(const ModelInfo& model, GroupRequest* request) {
  if (!request->audio) return nullptr;
  const std::vector<float> samples = std::exchange(request->samples, {});
  const auto& [rate, channel_count, first_sample] = *request->audio;
  const int64_t first = ResumeSample(*request->audio, request->Dynamics(), request->FirstFrame(),
                                     model, /*beats=*/false);
  const size_t channels = static_cast<size_t>(channel_count);
  const size_t skipped =
      std::min(static_cast<size_t>(first - first_sample) * channels, samples.size());
  std::span<const float> rest = std::span(samples).subspan(skipped);
  auto audio = std::make_unique<AudioFeed>(rate, channel_count,
                                           first_sample + static_cast<int64_t>(skipped / channels),
                                           model.music_features);
  const size_t second = static_cast<size_t>(rate) * channels;
  while (!rest.empty() && audio->ready() < request->FirstFrame() + request->frames) {
    const size_t count = std::min(second, rest.size());
    audio->Push(rest.first(count), audio->next_sample(), [] {});
    rest = rest.subspan(count);
  }
  if (rest.empty()) audio->Finish();
  return audio;
}

}  // namespace

void RankCandidates(std::vector<CandidateReport>& candidates, RankBy by) {
  constexpr double kSteeredStep = 0.01;  // metres
  constexpr double kSkateStep = 0.01;
  constexpr double kSupportStep = 0.05;  // three frames in two seconds
  std::ranges::sort(candidates, {}, [by](const CandidateReport& report) {
    const QualityReport& quality = report.quality;
    const double unlikely = -quality.log_likelihood.value_or(0);
    if (by == RankBy::kLikelihood)
      return std::tuple(0.0, 0.0, 0.0, 0.0, unlikely, report.candidate);
    const double steered = quality.keys.empty() ? 0 : quality.keys.front().correction_m;
    const double unsupported = 1 - quality.support.value_or(1);
    return std::tuple(report.strain, std::floor(steered / kSteeredStep),
                      std::floor(unsupported / kSupportStep),
                      std::floor(quality.skate_ratio / kSkateStep), unlikely, report.candidate);
  });
}

class TransitionGroup::Impl : public Delivery<GroupSink> {
 public:
  Impl(SampleQueue& queue, GroupRequest request, std::shared_ptr<GroupSink> sink)
      : Delivery(queue, &SampleQueue::SubmitBulk, std::move(sink)),
        room_(queue.ReserveBulk(request.candidates)),  // before any work that a refusal would waste
        request_(std::move(request)),
        controls_(model_),
        audio_(Feed(model_, &request_)) {}

  void Begin();

 private:
  using Call = Mailbox<GroupSink>::Call;

  class Candidate;

  Slices<> Measure(const TransitionRun& run);
  void Warn(const Warning& warning) {
    mailbox_.Post([warning](GroupSink& sink) { sink.OnWarning(warning); });
  }
  std::function<void()> TakeNext() override;
  void Drop() override { calls_.clear(); }
  double Due() const override { return due_; }

  const SampleQueue::Reservation room_;
  const double due_ = PlaybackClock();
  GroupRequest request_;  // without its samples
  ControlTrack controls_;
  const std::unique_ptr<AudioFeed> audio_;
  Segment segment_;

  // mutex_ guards the members below.
  std::deque<Call> calls_;  // the sampled candidates' frames and warnings
  std::vector<CandidateReport> reports_;
};

class TransitionGroup::Impl::Candidate : public Job {
 public:
  Candidate(std::shared_ptr<Impl> group, TransitionRun run)
      : Job(group, run.spec().frames, group->due_), group_(*group), run_(std::move(run)) {}

  void OnDone(const Error* failure) noexcept override {
    if (failure == nullptr) return;
    group_.React([&] { group_.mailbox_.PostError(*failure); });
    group_.Cancel();  // a ranking that lacks a candidate is worthless
  }

 private:
  TransitionRun Prepare() override { return std::move(run_); }
  Slices<> Finish() override { return group_.Measure(run()); }

  Impl& group_;  // kept alive by Job
  TransitionRun run_;
};

void TransitionGroup::Impl::Begin() {
  segment_ = {request_.FirstFrame(), request_.FirstFrame() + request_.frames};
  const int64_t from = segment_.from, end = segment_.to;
  if (const auto& target = request_.target)
    segment_.key = Key{.id = request_.target_id,
                       .frame = end - 1,
                       .pose = target->pose,
                       .mask = target->mask,
                       .hit = request_.hit};
  const auto changes = controls_.Set(request_.controls, from, "controls");
  // All candidates have the same request, so it is checked once and its warnings are sent once.
  DanceMusic music(model_, request_, request_.Dynamics(), audio_.get(), /*detects=*/false);
  const auto stage = request_.continuation ? request_.continuation->stage : std::nullopt;
  TransitionSpec spec = SpecOf(model_, request_, request_.seed, {request_.Before(), stage});
  spec.after = request_.after;
  spec.noise_like = Recurrence(model_.fps, request_.music_passages).Origins(from, end);
  PreparedTransition prepared = PrepareTransition(model_, {.spec = std::move(spec),
                                                           .controls = controls_,
                                                           .segment = segment_,
                                                           .music = music.PlanFor(segment_, end)});
  std::vector<Warning>& warnings = prepared.warnings;
  for (const Warning& warning : controls_.BehindEnd(end)) warnings.push_back(warning);
  for (const auto& [label, changed] : changes) {
    if (changed.last < from) warnings.push_back(ControlsTooLate(label, changed.last, from));
  }
  for (const Warning& warning : request_.Warnings(model_)) Warn(warning);
  for (const Warning& warning : warnings) Warn(warning);
  std::vector<std::shared_ptr<Candidate>> candidates;
  for (int number = 0; number < request_.candidates; ++number) {
    prepared.run.set_candidate(static_cast<uint32_t>(number));
    candidates.push_back(std::make_shared<Candidate>(
        std::static_pointer_cast<Impl>(shared_from_this()), prepared.run));
  }
  try {
    for (auto& candidate : candidates) queue_.SubmitBulk(std::move(candidate));
  } catch (...) {
    mailbox_.PostLast([](GroupSink&) {});  // the caller gets the exception; the sink gets no call
    Cancel();
    throw;
  }
  mailbox_.Deliver();
}

// Measures a candidate, and makes it ready to hand out.
Slices<> TransitionGroup::Impl::Measure(const TransitionRun& run) {
  const int candidate = static_cast<int>(run.spec().candidate);
  DanceMeter meter(model_, request_, run.StateAfter(0).history.back());
  meter.StartTransition(segment_);
  std::vector<Call> calls;
  for (int64_t frame = segment_.from; frame < segment_.to; ++frame) {
    if ((frame - segment_.from) % kFramesASlice == 0) co_await Pause();
    OutputFrames output =
        meter.Add(frame, run.frames()[static_cast<size_t>(frame - segment_.from)]);
    if (output.poses.empty()) continue;
    calls.emplace_back([candidate, output = std::move(output)](GroupSink& sink) {
      sink.OnFrames(candidate, output.first_frame, output.poses, output.contacts);
    });
  }
  if (run.arrival()) {
    KeyReached reached = *run.arrival();
    reached.id = request_.target_id;
    meter.AddKey(reached);
  }
  double strain = 0;
  for (Warning& warning : meter.TakeWarnings()) {
    strain = std::max(strain, warning.figure / warning.limit);
    if (request_.candidates > 1)
      warning.message = "candidate " + std::to_string(candidate) + ": " + warning.message;
    calls.emplace_back([warning](GroupSink& sink) { sink.OnWarning(warning); });
  }
  CandidateReport report{candidate, meter.Report(request_.music_beats),
                         meter.ContinuationAt(segment_.to, run.StateAfter(run.frames().size()),
                                              /*hears_beats=*/false),
                         strain};
  std::lock_guard lock(mutex_);
  std::ranges::move(calls, std::back_inserter(calls_));
  reports_.push_back(std::move(report));
}

std::function<void()> TransitionGroup::Impl::TakeNext() {
  if (!calls_.empty()) {
    Call next = std::move(calls_.front());
    calls_.pop_front();
    return [this, next = std::move(next)]() mutable { mailbox_.Post(std::move(next)); };
  }
  if (std::ssize(reports_) < request_.candidates) return {};
  return [this] {
    RankCandidates(reports_, request_.rank_by);
    for (const Warning& warning : controls_.Missed(reports_.front().quality)) Warn(warning);
    mailbox_.PostLast([ranked = reports_](GroupSink& sink) { sink.OnDone(ranked); });
  };
}

TransitionGroup::TransitionGroup(SampleQueue& queue, ValidGroup request,
                                 std::shared_ptr<GroupSink> sink) {
  impl_ = std::make_shared<Impl>(queue, *std::move(request), std::move(sink));
  impl_->Begin();
}

TransitionGroup::~TransitionGroup() { impl_->Cancel(); }

void TransitionGroup::SetPaused(bool paused) { impl_->SetPaused(paused); }
bool TransitionGroup::IsSampling() const { return impl_->IsSampling(); }
void TransitionGroup::Cancel() noexcept { impl_->Cancel(); }

}  // namespace choreo
