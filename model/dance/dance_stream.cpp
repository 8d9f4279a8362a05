#include "model/dance/dance_stream.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <mutex>
#include <utility>

#include "model/audio/feature_stream.h"
#include "model/audio/format.h"
#include "model/core/error.h"
#include "model/dance/audio_feed.h"
#include "model/dance/mailbox.h"
#include "model/dance/output_rate.h"
#include "model/dance/playback_clock.h"
#include "model/dance/validation.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

int64_t FirstFrame(const DanceConfig& config) {
  return config.continuation ? config.continuation->frame : 0;
}

// What a key that stands on the very first frame makes of the neutral stance before it.
Pose StanceOfFirstKey(const Skeleton& skeleton, const Key& key) {
  Pose stance = RestPose(skeleton);
  if (key.mask.root_position) stance.root_position = key.pose.root_position;
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    if (key.mask.joints.empty() || key.mask.joints[static_cast<size_t>(joint)]) {
      stance.rotations.col(joint) = key.pose.rotations.col(joint);
    }
  }
  return stance;
}

}  // namespace

void DanceConfig::Validate(const ModelInfo& model) const {
  if (temperature) ValidateTemperature(*temperature, "config.temperature");
  ValidateOutputFps(output_fps, "config.output_fps");
  if (history.size() > static_cast<size_t>(model.history_frames)) {
    throw InvalidArgument("config.history", std::to_string(history.size()) +
                                                " poses, the limit is " +
                                                std::to_string(model.history_frames));
  }
  ValidateHistory(model.skeleton, history, "config.history");
  if (continuation) {
    if (!history.empty()) {
      throw InvalidArgument("config.history", "and a continuation exclude each other");
    }
    ValidateContinuation(model, *continuation, allow_inexact_resume, "config.continuation");
  }
  const int64_t first = FirstFrame(*this);
  if (end_frame && (*end_frame <= 0 || *end_frame < first || *end_frame > kMaxDanceFrames)) {
    throw InvalidArgument("config.end_frame", std::to_string(*end_frame) + " is not in [" +
                                                  std::to_string(std::max<int64_t>(first, 1)) +
                                                  ", " + std::to_string(kMaxDanceFrames) + "]");
  }
  if (!audio) return;
  if (model.audio_features != kMfccCount || model.fps != 30) {
    throw Error(ErrorCode::kUnimplemented, "config.audio", "this model does not take music");
  }
  CheckAudioFormat(audio->sample_rate, audio->channels, "config.audio");
  const int64_t latest = DanceStream::LatestFirstSample(first, audio->sample_rate, model);
  if (audio->first_sample < 0 || audio->first_sample > latest) {
    throw Error(ErrorCode::kOutOfRange, "config.audio.first_sample",
                std::to_string(audio->first_sample) + " is not in [0, " + std::to_string(latest) +
                    "], so frame " + std::to_string(first) + " could not hear what lies before it");
  }
}

/// Lock order: messages_ before mutex_ before the scheduler's and the audio feed's. The sink is
/// called under none.
class DanceStream::Impl : public std::enable_shared_from_this<DanceStream::Impl> {
 public:
  Impl(Scheduler& scheduler, const DanceConfig& config, std::shared_ptr<DanceSink> sink);

  void Begin();
  void PushAudio(std::span<const float> interleaved, int64_t first_sample);
  void EndOfAudio();
  void SetMusicBeats(std::vector<double> seconds);
  void SetKey(const std::string& id, const KeyMoment& when, const Pose& pose, const PoseMask& mask);
  void RemoveKey(const std::string& id);
  void GenerateUntil(int64_t frame);
  void KeysComplete();
  void HalfClose();
  void SetPaused(bool paused);
  void Cancel() noexcept;

 private:
  class Job;

  // Those below are called with mutex_ held.
  void Advance(bool inherits);
  void Start();
  bool MayStart(bool inherits) const;
  void RetireIfOver();
  void WakeJob();
  void Post(const DanceEvent& event);
  void PostContinuation();
  void Summarise();
  void Fail(const Error& error);
  void Emit(const Segment& segment, const TransitionRun& run, const DanceFrame& frame);
  void FinishAudio();
  void CompleteKeys();

  // Applies a change to the timeline and goes on from there; what it throws leaves the stream as it
  // was.
  template <typename Change>
  void OnTimeline(Change change);

  Scheduler& scheduler_;
  const ModelInfo& model_;
  const DanceConfig config_;
  const int64_t first_frame_;
  const double start_time_ = PlaybackClock();
  std::atomic<bool> cancelled_ = false;
  std::atomic<bool> paused_ = false;
  Mailbox<DanceSink> mailbox_;

  std::mutex messages_;  // one message at a time
  int keyframe_messages_ = 0;
  int remove_messages_ = 0;

  std::mutex mutex_;                // of what follows
  std::optional<AudioFeed> audio_;  // its pushing side belongs to messages_
  Timeline timeline_;
  std::deque<Pose>
      history_;  // the last tau poses; empty until the first transition of a dance without any
  int64_t next_frame_;              // to be emitted
  std::optional<Segment> segment_;  // to be danced next, not yet submitted
  Job* job_ = nullptr;              // submitted and not done; the scheduler keeps it alive
  bool over_ = false;               // the last call to the sink is posted
  QualityMeter meter_;
  OutputRate output_;
  std::vector<double> music_beats_;  // seconds
};

/// One transition of the chain.
class DanceStream::Impl::Job : public StepJob {
 public:
  Job(std::shared_ptr<Impl> stream, const Segment& segment, const TransitionRequest& request)
      : stream_(std::move(stream)),
        segment_(segment),
        run_(stream_->model_, request),
        row_(static_cast<size_t>(stream_->model_.audio_features)) {}

  const TransitionSpec& spec() const override { return run_.spec(); }

  bool NextInput(StepInput* input) override {
    if (stream_->paused_) return false;
    const int64_t frame = segment_.from + run_.done();
    std::lock_guard lock(stream_->mutex_);
    if (!stream_->timeline_.Certain(frame)) return false;
    if (stream_->audio_) {
      if (!stream_->audio_->CopyRow(frame, row_)) return false;
      input->audio_row = row_;
    }
    input->previous = run_.previous();
    return true;
  }

  bool OnFrame(const StepOutput& raw) override {
    bool more = false;
    {
      std::lock_guard lock(stream_->mutex_);
      const DanceFrame frame = run_.Take(raw);
      stream_->Emit(segment_, run_, frame);
      const std::optional<int64_t> end = stream_->timeline_.End();
      more = run_.done() < run_.frames() && !(end && stream_->next_frame_ >= *end);
    }
    stream_->mailbox_.Deliver();
    return more;
  }

  void OnDone(const Error* failure) noexcept override {
    {
      std::lock_guard lock(stream_->mutex_);
      stream_->job_ = nullptr;
      if (failure != nullptr && !retired_) {
        stream_->Fail(*failure);
      } else {
        if (run_.done() > 0) stream_->PostContinuation();
        stream_->Advance(/*inherits=*/true);
      }
    }
    stream_->mailbox_.Deliver();
  }

  double NextDeadline() const override {
    const int64_t frame = segment_.from + run_.done() - stream_->first_frame_;
    return stream_->start_time_ + static_cast<double>(frame) / stream_->model_.fps;
  }

  bool Cancelled() const override { return retired_ || stream_->cancelled_; }

  /// The dance turned out to end before this transition's next frame: it ends in good order.
  void Retire() { retired_ = true; }

 private:
  const std::shared_ptr<Impl> stream_;
  const Segment segment_;
  TransitionRun run_;
  std::vector<float> row_;
  std::atomic<bool> retired_ = false;
};

DanceStream::Impl::Impl(Scheduler& scheduler, const DanceConfig& config,
                        std::shared_ptr<DanceSink> sink)
    : scheduler_(scheduler),
      model_(scheduler.model()),
      config_(config),
      first_frame_(FirstFrame(config)),
      mailbox_(std::move(sink)),
      timeline_({model_.fps, first_frame_, config.end_frame, config.audio.has_value(),
                 model_.max_transition_frames}),
      next_frame_(first_frame_),
      meter_(model_.skeleton, model_.fps, first_frame_),
      output_(model_.fps, config.output_fps, first_frame_,
              config.continuation ? std::optional(RoundToFloat(config.continuation->poses.back()))
                                  : std::nullopt),
      music_beats_(config.music_beats) {
  if (config.audio) {
    audio_.emplace(config.audio->sample_rate, config.audio->channels, config.audio->first_sample);
  }
  const std::vector<Pose>& given =
      config.continuation ? config.continuation->poses : config.history;
  if (given.empty()) return;
  const std::vector<Pose> history = FillHistory(model_, given);
  history_.assign(history.begin(), history.end());
}

void DanceStream::Impl::Begin() {
  if (config_.continuation && config_.continuation->fingerprint != model_.fingerprint) {
    Post(InexactResume(*config_.continuation, model_));
    mailbox_.Deliver();
  }
}

// ---- Messages -----------------------------------------------------------------------------------

template <typename Change>
void DanceStream::Impl::OnTimeline(Change change) {
  {
    std::lock_guard lock(mutex_);
    if (over_) return;
    change();
    RetireIfOver();
    Advance(/*inherits=*/false);
    WakeJob();
  }
  mailbox_.Deliver();
}

void DanceStream::Impl::PushAudio(std::span<const float> interleaved, int64_t first_sample) {
  std::lock_guard message(messages_);
  if (!audio_) throw InvalidArgument("audio", "comes without config.audio");
  {
    std::lock_guard lock(mutex_);
    if (over_) return;
  }
  audio_->Push(interleaved, first_sample, [this] { OnTimeline([] {}); });
}

void DanceStream::Impl::FinishAudio() {
  if (audio_->finished()) {
    throw Error(ErrorCode::kFailedPrecondition, "end_of_audio", "came before");
  }
  if (audio_->next_sample() == 0) throw InvalidArgument("audio", "ended without a sample");
  // Where the music ends is known before the rows behind its end can be danced.
  OnTimeline([this] { timeline_.SetAudioEnd(audio_->EndFrame(model_.fps)); });
  audio_->Finish();
  OnTimeline([] {});
}

void DanceStream::Impl::EndOfAudio() {
  std::lock_guard message(messages_);
  if (!audio_) throw InvalidArgument("end_of_audio", "comes without config.audio");
  FinishAudio();
}

void DanceStream::Impl::SetMusicBeats(std::vector<double> seconds) {
  std::lock_guard lock(mutex_);
  music_beats_ = std::move(seconds);
}

void DanceStream::Impl::SetKey(const std::string& id, const KeyMoment& when, const Pose& pose,
                               const PoseMask& mask) {
  std::lock_guard message(messages_);
  const std::string field = "keyframes[" + std::to_string(keyframe_messages_) + "]";
  ValidatePose(model_.skeleton, pose, field);
  ValidateMask(model_.skeleton, mask, field + ".mask");
  OnTimeline([&] {
    if (auto rejection = timeline_.Set(id, when, pose, mask, field)) Post(*rejection);
  });
  ++keyframe_messages_;
}

void DanceStream::Impl::RemoveKey(const std::string& id) {
  std::lock_guard message(messages_);
  const std::string field = "remove_keyframes[" + std::to_string(remove_messages_) + "]";
  OnTimeline([&] {
    if (auto rejection = timeline_.Remove(id, field)) Post(*rejection);
  });
  ++remove_messages_;
}

void DanceStream::Impl::GenerateUntil(int64_t frame) {
  std::lock_guard message(messages_);
  OnTimeline([&] { timeline_.GenerateUntil(frame); });
}

void DanceStream::Impl::CompleteKeys() {
  OnTimeline([this] {
    if (!audio_ && !config_.end_frame && timeline_.Empty()) {
      throw InvalidArgument("keyframes_complete",
                            "the dance has no end: no keyframe, no music and no end_frame");
    }
    timeline_.Complete();
  });
}

void DanceStream::Impl::KeysComplete() {
  std::lock_guard message(messages_);
  CompleteKeys();
}

void DanceStream::Impl::HalfClose() {
  std::lock_guard message(messages_);
  if (audio_ && !audio_->finished()) FinishAudio();
  bool complete = false;
  {
    std::lock_guard lock(mutex_);
    complete = timeline_.complete();
  }
  if (!complete) CompleteKeys();
}

void DanceStream::Impl::SetPaused(bool paused) {
  paused_ = paused;
  if (paused) return;
  std::lock_guard lock(mutex_);
  WakeJob();
}

void DanceStream::Impl::Cancel() noexcept {
  cancelled_ = true;
  {
    std::lock_guard lock(mutex_);
    if (job_ != nullptr) {
      WakeJob();  // OnDone follows
    } else {
      Fail(Error(ErrorCode::kCancelled, "", "cancelled"));
    }
  }
  mailbox_.Deliver();
}

// ---- The chain ----------------------------------------------------------------------------------

void DanceStream::Impl::WakeJob() {
  if (job_ != nullptr) scheduler_.Wake(job_);
}

void DanceStream::Impl::RetireIfOver() {
  const std::optional<int64_t> end = timeline_.End();
  // No step can be under way past the end: NextInput lets only certain frames through.
  if (job_ != nullptr && end && next_frame_ >= *end) job_->Retire();
}

bool DanceStream::Impl::MayStart(bool inherits) const {
  if (!timeline_.Certain(segment_->from)) return false;
  // A slot that is held already is kept while the music catches up; a new one is asked for when the
  // first frame can be made. Rows before the first frame are there once that frame's predecessor
  // has been danced.
  return !audio_ || audio_->ready() > (inherits ? segment_->from - 1 : segment_->from);
}

void DanceStream::Impl::Advance(bool inherits) {
  if (over_ || job_ != nullptr) return;
  if (cancelled_) return Fail(Error(ErrorCode::kCancelled, "", "cancelled"));
  const std::optional<int64_t> end = timeline_.End();
  if (timeline_.complete() && end && next_frame_ >= *end) return Summarise();
  if (!segment_) segment_ = timeline_.Next();
  if (segment_ && MayStart(inherits)) Start();
}

void DanceStream::Impl::Start() {
  if (history_.empty()) {
    const bool on_key = segment_->key && segment_->to == 1;
    const Pose stance =
        on_key ? StanceOfFirstKey(model_.skeleton, *segment_->key) : RestPose(model_.skeleton);
    const std::vector<Pose> history = FillHistory(model_, {&stance, 1});
    history_.assign(history.begin(), history.end());
  }
  TransitionRequest request;
  request.frames = static_cast<int>(segment_->to - segment_->from);
  request.history.assign(history_.begin(), history_.end());
  if (segment_->key) request.target = WorldTarget{segment_->key->pose, segment_->key->mask};
  request.seed = config_.seed;
  request.candidate = config_.candidate;
  request.first_frame = segment_->from;
  request.temperature =
      config_.temperature.value_or(static_cast<float>(model_.default_temperature));
  try {
    if (audio_) {
      request.has_audio = true;
      request.audio_history = audio_->History(segment_->from, model_.history_frames);
    }
    auto job = std::make_shared<Job>(shared_from_this(), *segment_, request);
    job_ = job.get();
    scheduler_.Submit(std::move(job));
    segment_.reset();
  } catch (const Error& error) {
    job_ = nullptr;
    Fail(error);
  }
}

void DanceStream::Impl::Emit(const Segment& segment, const TransitionRun& run,
                             const DanceFrame& frame) {
  if (run.done() == 1) {
    const std::optional<RequiredSpeed> speed = run.required_speed();
    if (speed && speed->TooFast()) {
      Post(IntervalTooShort(model_.skeleton, segment.key->id, segment.from,
                            segment.to - segment.from, *speed));
    }
  }
  ++next_frame_;
  history_.push_back(frame.pose);
  history_.pop_front();
  meter_.Add(frame);
  OutputFrames frames = output_.Push(frame);
  if (!frames.poses.empty()) {
    mailbox_.Post([frames = std::move(frames)](DanceSink& sink) {
      sink.OnFrames(frames.first_frame, frames.poses, frames.contacts);
    });
  }
  if (run.arrival()) {
    meter_.AddKey(segment.key->id, *run.arrival());
    const int64_t key_frame = segment.to - 1;
    Post(KeyReached{segment.key->id, key_frame, static_cast<double>(key_frame) / model_.fps,
                    *run.arrival()});
  }
}

void DanceStream::Impl::Post(const DanceEvent& event) {
  mailbox_.Post([event](DanceSink& sink) { sink.OnEvent(event); });
}

void DanceStream::Impl::PostContinuation() {
  Continuation continuation{next_frame_, {history_.begin(), history_.end()}, model_.fingerprint};
  mailbox_.Post([continuation = std::move(continuation)](DanceSink& sink) {
    sink.OnContinuation(continuation);
  });
}

void DanceStream::Impl::Summarise() {
  over_ = true;
  std::vector<double> beats;
  for (double seconds : music_beats_) beats.push_back(seconds * model_.fps);
  mailbox_.Post([report = meter_.Report(beats)](DanceSink& sink) { sink.OnSummary(report); });
}

void DanceStream::Impl::Fail(const Error& error) {
  if (over_) return;
  over_ = true;
  mailbox_.Post([error](DanceSink& sink) { sink.OnError(error); });
}

// ---- The interface ------------------------------------------------------------------------------

DanceStream::DanceStream(Scheduler& scheduler, const DanceConfig& config,
                         std::shared_ptr<DanceSink> sink) {
  config.Validate(scheduler.model());
  impl_ = std::make_shared<Impl>(scheduler, config, std::move(sink));
  impl_->Begin();
}

DanceStream::~DanceStream() { impl_->Cancel(); }

void DanceStream::PushAudio(std::span<const float> interleaved, int64_t first_sample) {
  impl_->PushAudio(interleaved, first_sample);
}
void DanceStream::EndOfAudio() { impl_->EndOfAudio(); }
void DanceStream::SetMusicBeats(std::vector<double> seconds) {
  impl_->SetMusicBeats(std::move(seconds));
}
void DanceStream::SetKey(const std::string& id, const KeyMoment& when, const Pose& pose,
                         const PoseMask& mask) {
  impl_->SetKey(id, when, pose, mask);
}
void DanceStream::RemoveKey(const std::string& id) { impl_->RemoveKey(id); }
void DanceStream::GenerateUntil(int64_t frame) { impl_->GenerateUntil(frame); }
void DanceStream::KeysComplete() { impl_->KeysComplete(); }
void DanceStream::HalfClose() { impl_->HalfClose(); }
void DanceStream::SetPaused(bool paused) { impl_->SetPaused(paused); }
void DanceStream::Cancel() noexcept { impl_->Cancel(); }

int DanceStream::LatencyFrames(const DanceConfig& config, const ModelInfo& model) {
  double seconds = 0;
  if (config.audio) {
    seconds +=
        static_cast<double>(
            FeatureStream(config.audio->sample_rate, config.audio->channels).latency_samples()) /
        kModelSampleRate;
  }
  if (config.output_fps != model.fps) seconds += 1 / model.fps;
  return static_cast<int>(std::ceil(seconds * config.output_fps));
}

int64_t DanceStream::LatestFirstSample(int64_t first_frame, double sample_rate,
                                       const ModelInfo& model) {
  return FeatureStream::FirstSampleFor(std::max<int64_t>(0, first_frame - model.history_frames),
                                       sample_rate);
}

}  // namespace choreo
