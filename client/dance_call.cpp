#include "client/dance_call.h"

#include <cmath>
#include <utility>

#include "client/convert.h"
#include "client/retry_advice.h"

namespace choreo::client {
namespace {

/// Of all channels together; 0 for a music file, and without music.
int BytesPerSample(const v1::AudioFormat& format) {
  if (format.encoding() != v1::AUDIO_ENCODING_PCM_F32LE) return 0;
  return static_cast<int>(format.channels() * sizeof(float));
}

}  // namespace

Attempt::Attempt(const Replicas& replicas, const v1::StreamDanceRequest& first,
                 std::optional<Patience::Clock::time_point> deadline,
                 const std::string& resumed_from, Journal* journal, std::mutex* mutex)
    : server_(replicas.current()), journal_(journal), mutex_(mutex) {
  replicas.Prepare(&context_);
  if (!resumed_from.empty()) context_.AddMetadata("choreo-resumed-from", resumed_from);
  if (deadline) context_.set_deadline(*deadline);
  // Otherwise StreamDance would wait for a connection while it holds `mutex`.
  context_.set_initial_metadata_corked(true);
  stream_ = server_.stub->StreamDance(&context_);
  sender_ = std::thread([this, first] { SendLoop(first); });
}

std::string Attempt::StreamId() const {
  const auto& headers = context_.GetServerInitialMetadata();
  const auto id = headers.find("choreo-stream-id");
  return id == headers.end() ? "" : std::string(id->second.data(), id->second.size());
}

Attempt::~Attempt() {
  if (finished_) return;
  Cancel();
  Finish();
}

void Attempt::SendLoop(const v1::StreamDanceRequest& first) {
  if (!stream_->Write(first)) return;
  for (;;) {
    Journal::Request request;
    {
      std::unique_lock lock(*mutex_);
      appended_.wait(lock, [&] { return stop_ || (request = journal_->TakeNext()) != nullptr; });
      if (stop_) return;
    }
    // Write returns false once the call is over; Read then reports why.
    if (!stream_->Write(*request)) return;
  }
}

grpc::Status Attempt::Finish() {
  {
    const std::lock_guard lock(*mutex_);
    stop_ = true;
  }
  appended_.notify_one();
  sender_.join();
  finished_ = true;
  return stream_->Finish();
}

DanceCall::DanceCall(std::shared_ptr<Replicas> replicas, v1::DanceConfig config)
    : replicas_(std::move(replicas)),
      patience_(replicas_->options()),
      config_(std::move(config)),
      journal_(BytesPerSample(config_.audio_format()),
               BytesPerSample(config_.audio_format()) > 0
                   ? config_.continuation().audio_from_sample()
                   : 0) {
  config_.set_allow_inexact_resume(replicas_->options().allow_inexact_resume);
}

DanceCall::~DanceCall() { Cancel(); }

void DanceCall::Send(v1::StreamDanceRequest request) {
  const std::lock_guard lock(mutex_);
  journal_.Append(std::move(request));
  if (attempt_) attempt_->NotifyAppended();
}

void DanceCall::Connect() {
  const std::lock_guard lock(mutex_);
  if (cancelled_) return;
  journal_.Rewind();
  v1::StreamDanceRequest first;
  *first.mutable_config() = config_;
  if (BytesPerSample(config_.audio_format()) > 0) {
    first.mutable_config()->mutable_audio_format()->set_first_sample(journal_.first_sample());
  }
  attempt_ = std::make_unique<Attempt>(*replicas_, first, patience_.deadline(), first_stream_id_,
                                       &journal_, &mutex_);
}

std::optional<DanceCall::Answer> DanceCall::Next() {
  if (complete_) return std::nullopt;
  for (;;) {
    if (!attempt_) Connect();
    if (!attempt_) throw Error(ErrorCode::kCancelled, "", "the dance was cancelled");
    v1::StreamDanceResponse response;
    bool refused = false;
    while (attempt_->Read(&response)) {
      refused = response.has_header() && IsOtherDance(response.header());
      if (refused) break;
      std::optional<Answer> answer = Handle(&response);
      if (answer) return answer;
    }
    if (refused) attempt_->Cancel();
    grpc::Status status = attempt_->Finish();
    if (refused) {
      status = RefusedFingerprint(fingerprint_, attempt_->server().address,
                                  response.header().fingerprint());
    } else if (status.ok()) {
      status = {grpc::StatusCode::UNAVAILABLE, "the server ended the dance before its summary"};
    }
    Recover(status);
  }
}

void DanceCall::Recover(const grpc::Status& status) {
  std::unique_lock lock(mutex_);
  const Replicas::Server failed = attempt_->server();
  attempt_.reset();
  if (cancelled_) throw Error(ErrorCode::kCancelled, "", "the dance was cancelled");
  const auto wait = patience_.Next(status, failed.address, replicas_->Leave(failed));
  if (!wait) throw ToError(patience_.Verdict(), patience_.VerdictOf(), replicas_->options());
  lock.unlock();
  replicas_->TellOfRetry(failed, status);
  replicas_->Wait(*wait, [&] {
    const std::lock_guard guard(mutex_);
    return cancelled_;
  });
  lock.lock();
  if (!header_) return;
  lost_because_ = status.error_message().empty() ? "lost" : status.error_message();
  filter_->Restart();
}

std::optional<DanceCall::Answer> DanceCall::Handle(v1::StreamDanceResponse* response) {
  // A newer version of the protocol may have others.
  if (response->response_case() == v1::StreamDanceResponse::RESPONSE_NOT_SET) return std::nullopt;
  if (response->has_header()) {
    if (header_) return Resume(response->header());
    Begin(response->header());
  } else if (!header_) {
    throw wire::Broken("no header came first");
  } else if (response->has_frames()) {
    CheckFrames(response->frames(), header_->skeleton.joints());
    if (!filter_->Admit(response->mutable_frames())) return std::nullopt;
    patience_.Reset();
  } else if (response->has_event()) {
    if (!filter_->Admit(response->event())) return std::nullopt;
  } else if (response->has_continuation()) {
    HandleContinuation(response->continuation());
  } else {
    HandleSummary(response->mutable_summary());
  }
  return std::move(*response);
}

bool DanceCall::IsOtherDance(const v1::Header& header) const {
  return header_ && !config_.has_continuation() && header.fingerprint() != fingerprint_ &&
         !config_.allow_inexact_resume();
}

void DanceCall::Begin(const v1::Header& header) {
  header_ = FromProto(header);
  fingerprint_ = header.fingerprint();
  first_stream_id_ = attempt_->StreamId();
  // The first output frame at or after the first frame.
  const double first =
      static_cast<double>(header_->first_frame) * header_->fps / header_->model_fps;
  filter_.emplace(header_->first_frame, static_cast<int64_t>(std::ceil(first - 1e-9)));
  // Another server must generate the same dance with the same model.
  config_.set_seed(header.seed());
  config_.set_model(header.model());
}

Resumed DanceCall::Resume(const v1::Header& header) {
  // Servers compare fingerprints only if there is a continuation.
  const bool exact =
      config_.has_continuation() ? header.exact_resume() : header.fingerprint() == fingerprint_;
  fingerprint_ = header.fingerprint();
  if (header.frame_rate() != header_->fps ||
      header.skeleton().parents_size() != header_->skeleton.joints()) {
    throw Error(ErrorCode::kInternal, "",
                "the server that should resume the dance has another frame rate or body");
  }
  return {attempt_->server().address, filter_->next_frame(), exact, lost_because_};
}

void DanceCall::HandleContinuation(const v1::Continuation& continuation) {
  *config_.mutable_continuation() = continuation;
  const std::lock_guard lock(mutex_);
  journal_.ForgetMusicBefore(continuation.audio_from_sample());
}

void DanceCall::HandleSummary(v1::DanceSummary* summary) {
  // The server counts only its own frames: adds the earlier servers'.
  v1::QualityReport& report = *summary->mutable_report();
  report.set_frames(report.frames() + report.first_frame() - header_->first_frame);
  complete_ = true;
  // Everything has been received, so the status does not matter.
  v1::StreamDanceResponse rest;
  while (attempt_->Read(&rest)) {
  }
  attempt_->Finish();
}

void DanceCall::Cancel() noexcept {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  if (attempt_) attempt_->Cancel();
}

}  // namespace choreo::client
