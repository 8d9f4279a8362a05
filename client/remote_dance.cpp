#include "client/remote_dance.h"

#include <algorithm>
#include <cmath>

#include "client/retry_advice.h"

namespace choreo::client {
namespace {

/// Small enough for a dance to begin early, large enough to be cheap.
constexpr size_t kMusicChunkBytes = size_t{128} * 1024;

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

RemoteDance::Impl::Impl(std::shared_ptr<Replicas> replicas, const DanceConfig& config)
    : replicas_(std::move(replicas)),
      patience_(replicas_->options()),
      audio_kind_(config.audio.kind),
      bytes_per_sample_(audio_kind_ == AudioKind::kPcmFloat
                            ? config.audio.channels * static_cast<int>(sizeof(float))
                            : 0),
      config_(ToProto(config)),
      journal_(bytes_per_sample_, bytes_per_sample_ > 0 && config.continuation
                                      ? config.continuation->audio_from_sample
                                      : 0) {
  config_.set_allow_inexact_resume(replicas_->options().allow_inexact_resume);
}

RemoteDance::Impl::~Impl() { Cancel(); }

void RemoteDance::Impl::Send(v1::StreamDanceRequest request) {
  const std::lock_guard lock(mutex_);
  journal_.Append(std::move(request));
  if (attempt_) attempt_->NotifyAppended();
}

void RemoteDance::Impl::SendMusic(std::string_view bytes) {
  const auto unit = static_cast<size_t>(std::max(1, bytes_per_sample_));
  const size_t chunk = kMusicChunkBytes / unit * unit;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(chunk, bytes.size()))) {
    const std::lock_guard lock(mutex_);
    journal_.AppendMusic(std::string(bytes.substr(0, chunk)));
    if (attempt_) attempt_->NotifyAppended();
  }
}

void RemoteDance::Impl::Connect() {
  const std::lock_guard lock(mutex_);
  if (cancelled_) return;
  journal_.Rewind();
  v1::StreamDanceRequest first;
  *first.mutable_config() = config_;
  if (config_.has_audio_format() && bytes_per_sample_ > 0) {
    first.mutable_config()->mutable_audio_format()->set_first_sample(journal_.first_sample());
  }
  attempt_ = std::make_unique<Attempt>(*replicas_, first, patience_.deadline(), first_stream_id_,
                                       &journal_, &mutex_);
}

std::optional<Message> RemoteDance::Impl::Next() {
  if (complete_) return std::nullopt;
  for (;;) {
    if (!attempt_) Connect();
    if (!attempt_) throw Error(ErrorCode::kCancelled, "", "the dance was cancelled");
    v1::StreamDanceResponse response;
    bool refused = false;
    while (attempt_->Read(&response)) {
      refused = response.has_header() && IsOtherDance(response.header());
      if (refused) break;
      std::optional<Message> message = Handle(response);
      if (message) return message;
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

void RemoteDance::Impl::Recover(const grpc::Status& status) {
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
  const int64_t frame =
      config_.has_continuation() ? config_.continuation().frame() : header_->first_frame;
  filter_->Restart(frame, journal_.KeysBefore(frame, header_->model_fps));
}

std::optional<Message> RemoteDance::Impl::Handle(const v1::StreamDanceResponse& response) {
  switch (response.response_case()) {
    case v1::StreamDanceResponse::kHeader:
      return HandleHeader(response.header());
    case v1::StreamDanceResponse::kSummary:
      return HandleSummary(response.summary());
    case v1::StreamDanceResponse::RESPONSE_NOT_SET:
      return std::nullopt;  // from a newer version of the protocol
    default:
      break;
  }
  if (!header_) {
    throw Error(ErrorCode::kInternal, "", "the server broke the protocol: no header came first");
  }
  if (response.has_frames()) {
    FrameBlock block = FromProto(response.frames(), header_->skeleton.joints());
    if (!filter_->Admit(&block)) return std::nullopt;
    patience_.Reset();
    return block;
  }
  if (response.has_continuation()) {
    *config_.mutable_continuation() = response.continuation();
    const std::lock_guard lock(mutex_);
    journal_.ForgetMusicBefore(response.continuation().audio_from_sample());
    return FromProto(response.continuation());
  }
  const std::optional<DanceEvent> event = FromProto(response.event());
  if (!event || !filter_->Admit(*event)) return std::nullopt;
  return std::visit([](const auto& said) { return Message(said); }, *event);
}

bool RemoteDance::Impl::IsOtherDance(const v1::Header& header) const {
  return header_ && !config_.has_continuation() && header.fingerprint() != fingerprint_ &&
         !config_.allow_inexact_resume();
}

Message RemoteDance::Impl::HandleHeader(const v1::Header& header) {
  Header received = FromProto(header);
  // Servers compare fingerprints only if there is a continuation.
  const bool exact =
      config_.has_continuation() ? header.exact_resume() : header.fingerprint() == fingerprint_;
  fingerprint_ = header.fingerprint();
  if (!header_) {
    header_ = received;
    first_stream_id_ = attempt_->StreamId();
    // The first output frame at or after the first frame.
    const double first =
        static_cast<double>(received.first_frame) * received.fps / received.model_fps;
    filter_.emplace(static_cast<int64_t>(std::ceil(first - 1e-9)));
    // Another server must generate the same dance with the same model.
    config_.set_seed(received.seed);
    config_.set_model(received.model);
    return received;
  }
  if (received.fps != header_->fps || received.skeleton.joints() != header_->skeleton.joints()) {
    throw Error(ErrorCode::kInternal, "",
                "the server that should resume the dance has another frame rate or body");
  }
  return Resumed{attempt_->server().address, filter_->next_frame(), exact, lost_because_};
}

Message RemoteDance::Impl::HandleSummary(const v1::DanceSummary& summary) {
  Report report = FromProto(summary.report(), summary.timing());
  // The server counts only its own frames: adds the earlier servers'.
  report.frames += report.measured_from - header_->first_frame;
  complete_ = true;
  // Everything has been received, so the status does not matter.
  v1::StreamDanceResponse rest;
  while (attempt_->Read(&rest)) {
  }
  attempt_->Finish();
  return report;
}

void RemoteDance::Impl::Cancel() noexcept {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  if (attempt_) attempt_->Cancel();
}

}  // namespace choreo::client
