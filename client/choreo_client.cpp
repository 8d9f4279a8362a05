#include "client/choreo_client.h"

#include <algorithm>
#include <map>

#include "client/convert.h"
#include "client/dance_call.h"
#include "client/replicas.h"
#include "proto/wire/control_messages.h"

namespace choreo::client {
namespace {

/// Calls `call(server, context)` until it succeeds or a retry is useless.
template <typename Call>
void CallWithRetries(Replicas* replicas, const Call& call) {
  Patience patience(replicas->options());
  for (;;) {
    grpc::ClientContext context;
    if (patience.deadline()) context.set_deadline(*patience.deadline());
    replicas->Prepare(&context);
    const Replicas::Server server = replicas->current();
    const grpc::Status status = call(server, &context);
    if (status.ok()) return;
    const auto wait = patience.Next(status, server.address, replicas->Leave(server));
    if (!wait) throw ToError(patience.Verdict(), patience.VerdictOf(), replicas->options());
    replicas->TellOfRetry(server, status);
    replicas->Wait(*wait, [] { return false; });
  }
}

bool AreAsked(const ControlRequest& controls) { return wire::ToProto(controls).ByteSizeLong() > 0; }

v1::GenerateTransitionRequest MakeRequest(const TransitionRequest& request) {
  v1::GenerateTransitionRequest out;
  DanceConfig config = request.config;
  config.audio = request.audio.format;
  *out.mutable_config() = ToProto(config);
  out.set_frames(request.frames);
  if (const auto& target = request.target) {
    *out.mutable_target() = ToProto(target->pose, target->mask);
    if (!target->mask.joints.empty()) *out.mutable_target_mask() = ToProto(target->mask);
    if (target->hit) out.set_target_hit(*target->hit);
    out.set_target_id(target->id);
  }
  switch (request.audio.format.kind) {
    case AudioKind::kNone:
      break;
    case AudioKind::kPcmFloat:
      out.mutable_audio()->set_data(ToPcmBytes(request.audio.samples));
      break;
    case AudioKind::kFile:
      out.mutable_audio()->set_data(request.audio.bytes.data(), request.audio.bytes.size());
      break;
  }
  if (request.audio.format.kind != AudioKind::kNone) {
    out.mutable_audio()->set_first_sample(request.audio_first_sample);
    out.mutable_config()->mutable_audio_format()->set_first_sample(request.audio_first_sample);
  }
  for (const Pose& pose : request.after) *out.add_after() = ToProto(pose);
  out.set_candidates(static_cast<uint32_t>(request.candidates));
  if (request.rank_by == RankBy::kLikelihood) out.set_rank_by(v1::RANK_BY_LIKELIHOOD);
  if (AreAsked(config.controls)) *out.mutable_controls() = wire::ToProto(config.controls);
  return out;
}

/// Collects the answers of one GenerateTransition.
class TransitionCollector {
 public:
  void Add(const v1::GenerateTransitionResponse& response) {
    if (response.has_header()) {
      result_.header = FromProto(response.header());
    } else if (response.has_frames()) {
      Append(FromProto(response.frames(), result_.header.skeleton.joints()));
    } else if (response.has_event()) {
      const std::optional<DanceEvent> event = FromProto(response.event());
      if (const auto* warning = event ? std::get_if<Warning>(&*event) : nullptr)
        result_.warnings.push_back(*warning);
    } else if (response.has_summary()) {
      complete_ = true;
      for (const v1::Candidate& candidate : response.summary().candidates()) {
        TransitionCandidate& best = candidates_[candidate.candidate()];
        best.candidate = candidate.candidate();
        best.report = FromProto(candidate.report(), response.summary().timing());
        best.continuation = FromProto(candidate.continuation());
        best.motion.fps = result_.header.fps;
        result_.candidates.push_back(std::move(best));
      }
    }
  }
  bool complete() const { return complete_; }
  TransitionResult Result() { return std::move(result_); }

 private:
  void Append(FrameBlock block) {
    TransitionCandidate& candidate = candidates_[block.candidate];
    std::move(block.poses.begin(), block.poses.end(), std::back_inserter(candidate.motion.frames));
    candidate.contacts.insert(candidate.contacts.end(), block.contacts.begin(),
                              block.contacts.end());
  }

  TransitionResult result_;
  std::map<uint32_t, TransitionCandidate> candidates_;
  bool complete_ = false;
};

/// Collects the messages of a dance in its result.
struct DanceCollector {
  DanceResult* result;

  void operator()(Header& header) const {
    result->header = header;
    result->motion.fps = header.fps;
  }
  void operator()(FrameBlock& block) const {
    std::move(block.poses.begin(), block.poses.end(), std::back_inserter(result->motion.frames));
    result->contacts.insert(result->contacts.end(), block.contacts.begin(), block.contacts.end());
  }
  void operator()(KeyRejected& rejected) const { result->rejected.push_back(rejected); }
  void operator()(Beat& beat) const { result->beats.push_back(beat); }
  void operator()(Warning& warning) const { result->warnings.push_back(warning); }
  void operator()(Resumed&) const { ++result->resumes; }
  void operator()(Report& report) const { result->report = report; }
  void operator()(KeyReached&) const {}
  void operator()(Continuation&) const {}
};

}  // namespace

struct Client::Impl {
  std::shared_ptr<Replicas> replicas;
};

Client::Client(Options options)
    : impl_(std::make_unique<Impl>(Impl{std::make_shared<Replicas>(std::move(options))})) {}
Client::~Client() = default;
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;

ServerDescription Client::GetServerInfo() const {
  v1::GetServerInfoResponse response;
  CallWithRetries(impl_->replicas.get(), [&](const auto& server, grpc::ClientContext* context) {
    return server.stub->GetServerInfo(context, {}, &response);
  });
  return FromProto(response);
}

bool Client::IsServing() const {
  grpc::health::v1::HealthCheckResponse response;
  CallWithRetries(impl_->replicas.get(), [&](const auto& server, grpc::ClientContext* context) {
    return server.health->Check(context, {}, &response);
  });
  return response.status() == grpc::health::v1::HealthCheckResponse::SERVING;
}

std::unique_ptr<RemoteDance> Client::StartDance(const DanceConfig& config) const {
  std::unique_ptr<RemoteDance> dance(
      new RemoteDance(std::make_unique<DanceCall>(impl_->replicas, ToProto(config)), config.audio));
  if (AreAsked(config.controls)) dance->SendControls(config.controls);
  return dance;
}

DanceResult Client::Dance(DanceConfig config, const std::vector<KeyPose>& keys, const Audio& audio,
                          const std::function<void(const Message&)>& observer) const {
  DanceResult result;
  Dance(std::move(config), keys, audio, observer, &result);
  return result;
}

void Client::Dance(DanceConfig config, const std::vector<KeyPose>& keys, const Audio& audio,
                   const std::function<void(const Message&)>& observer, DanceResult* result) const {
  config.audio = audio.format;
  const std::unique_ptr<RemoteDance> dance = StartDance(config);
  // Sends the keys first: no key can then come late, and the first frames need little of the music.
  for (const KeyPose& key : keys) dance->SendKey(key);
  dance->CompleteKeys();
  if (audio.format.kind == AudioKind::kPcmFloat) dance->SendSamples(audio.samples);
  if (audio.format.kind == AudioKind::kFile) dance->SendBytes(audio.bytes);
  if (audio.format.kind != AudioKind::kNone) dance->EndAudio();

  while (std::optional<Message> message = dance->Next()) {
    if (observer) observer(*message);
    std::visit(DanceCollector{result}, *message);
  }
}

TransitionResult Client::GenerateTransition(const TransitionRequest& request) const {
  const v1::GenerateTransitionRequest message = MakeRequest(request);
  TransitionResult result;
  CallWithRetries(impl_->replicas.get(),
                  [&](const auto& server, grpc::ClientContext* context) -> grpc::Status {
                    TransitionCollector collector;
                    const auto reader = server.stub->GenerateTransition(context, message);
                    v1::GenerateTransitionResponse response;
                    while (reader->Read(&response)) collector.Add(response);
                    grpc::Status status = reader->Finish();
                    if (!status.ok()) return status;
                    if (!collector.complete()) {
                      return {grpc::StatusCode::UNAVAILABLE,
                              "the server ended the transition before its summary"};
                    }
                    result = collector.Result();
                    return status;
                  });
  return result;
}

}  // namespace choreo::client
