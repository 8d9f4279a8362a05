#include "server/calls/service.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "model/audio/signal/format.h"
#include "model/dance/timeline/timeline.h"
#include "model/dance/timeline/validation.h"
#include "proto/wire/convert.h"
#include "server/calls/describe_model.h"
#include "server/calls/stream_reactor.h"
#include "server/calls/transition_reactor.h"
#include "server/messages/music_file.h"
#include "server/messages/read_message.h"
#include "server/messages/refusal.h"
#include "server/messages/status.h"

namespace choreo {
namespace {

// Unread answers per address; each takes tens of kilobytes until it is read.
constexpr int kMaxUnreadInfos = 64;

void FillLimits(const CallLimits& of_calls, v1::Limits* limits) {
  const auto seconds = [](std::chrono::milliseconds time) {
    return std::chrono::duration<double>(time).count();
  };
  limits->set_max_streams(of_calls.calls);
  limits->set_max_streams_of_peer(of_calls.calls_of_caller);
  limits->set_first_message_s(seconds(of_calls.first_message));
  limits->set_idle_s(seconds(of_calls.idle));
  limits->set_unread_s(seconds(of_calls.unread));
}

}  // namespace

grpc::ServerWriteReactor<grpc::ByteBuffer>* ChoreographyService::GenerateTransition(
    grpc::CallbackServerContext* context, const grpc::ByteBuffer* request) {
  return MakeTransitionReactor(serving_, context, request);
}

grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* ChoreographyService::StreamDance(
    grpc::CallbackServerContext* context) {
  return MakeStreamReactor(serving_, context);
}

/// Lives until its answer is sent or the call is cancelled.
class ChoreographyService::InfoReactor final : public grpc::ServerUnaryReactor {
 public:
  InfoReactor(ChoreographyService& service, std::string address)
      : service_(service), address_(std::move(address)) {
    const std::lock_guard lock(service_.mutex_);
    within_ = ++service_.unread_infos_[address_] <= kMaxUnreadInfos;
  }
  bool within() const { return within_; }
  void OnDone() override {
    {
      const std::lock_guard lock(service_.mutex_);
      const auto at = service_.unread_infos_.find(address_);
      if (--at->second == 0) service_.unread_infos_.erase(at);
    }
    delete this;
  }

 private:
  ChoreographyService& service_;
  const std::string address_;
  bool within_ = false;
};

grpc::ServerUnaryReactor* ChoreographyService::GetServerInfo(
    grpc::CallbackServerContext* context, const v1::GetServerInfoRequest* request,
    v1::GetServerInfoResponse* response) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  Caller caller = CallerOf(*context);
  auto* reactor = new InfoReactor(*this, AddressOf(caller.peer));
  std::optional<Refusal> refusal;
  grpc::Status status =
      serving_.tokens.FindHolder(HeaderOf(*context, "authorization"), &caller.holder);
  if (!status.ok()) {
    refusal = Refusal::kToken;
  } else if (!reactor->within()) {
    refusal = Refusal::kUnreadInfos;
    status = ToStatus(
        Refused(*refusal, std::to_string(kMaxUnreadInfos) +
                              " answers wait to be read by your address, the most allowed"));
  }
  if (status.ok()) Describe(response);
  if (request->without_cards()) {
    for (v1::ModelInfo& model : *response->mutable_models()) model.clear_card();
  }
  serving_.tally.Count({.method = Tally::kInfoMethod,
                        .caller = caller,
                        .status = status,
                        .seconds = std::chrono::duration<double>(Clock::now() - begin).count(),
                        .refusal = refusal});
  reactor->Finish(status);
  return reactor;
}

void ChoreographyService::Describe(v1::GetServerInfoResponse* response) const {
  response->set_version(CHOREO_VERSION);
  v1::Limits* limits = response->mutable_limits();
  limits->set_max_message_bytes(kMaxMessageBytes);
  limits->set_max_audio_s(kMaxAudioSeconds);
  limits->set_max_audio_file_bytes(kMaxAudioFileBytes);
  limits->set_max_audio_file_samples(kMaxFileSamples);
  limits->set_max_other_bytes(kMaxOtherBytes);
  limits->set_max_history_poses(kMaxHistoryPoses);
  limits->set_max_after_poses(kMaxAfterPoses);
  limits->set_max_keyframes(kMaxKeys);
  limits->set_max_transition_frames(kMaxTransitionFrames);
  limits->set_max_candidates(serving_.max_candidates);
  limits->set_max_frame_rate(kMaxOutputFps);
  FillLimits(serving_.calls.limits(), limits);
  int workers = 0;
  for (const Models::Use& queue : serving_.models.served()) {
    *response->add_models() = wire::ToProto(DescribeModel(queue->model()));
    workers += queue->stats().workers;
    for (const std::string& device : queue->devices()) {
      const auto& known = response->devices();
      if (std::find(known.begin(), known.end(), device) == known.end()) {
        response->add_devices(device);
      }
    }
  }
  response->set_slots(workers);
  response->set_active_streams(serving_.calls.count());
  response->set_draining(!serving_.calls.admitting());
}

}  // namespace choreo
