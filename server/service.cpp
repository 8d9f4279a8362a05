#include "server/service.h"

#include <algorithm>
#include <chrono>

#include "model/audio/format.h"
#include "model/dance/timeline.h"
#include "model/dance/validation.h"
#include "server/music_file.h"
#include "server/read_message.h"
#include "server/stream_reactor.h"
#include "server/transition_reactor.h"
#include "server/write_response.h"

namespace choreo {
namespace {

void FillLimits(const CallLimits& of_calls, v1::Limits* limits) {
  const auto seconds = [](std::chrono::milliseconds time) {
    return std::chrono::duration<double>(time).count();
  };
  limits->set_max_streams(of_calls.calls);
  limits->set_max_streams_of_peer(of_calls.calls_of_peer);
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

grpc::ServerUnaryReactor* ChoreographyService::GetServerInfo(
    grpc::CallbackServerContext* context, const v1::GetServerInfoRequest* /*request*/,
    v1::GetServerInfoResponse* response) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  Caller caller = CallerOf(*context);
  const grpc::Status status =
      serving_.tokens.FindHolder(HeaderOf(*context, "authorization"), &caller.holder);
  if (status.ok()) Describe(response);
  serving_.tally.Count({.method = "GetServerInfo",
                        .caller = caller,
                        .status = status,
                        .seconds = std::chrono::duration<double>(Clock::now() - begin).count()});
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
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
  limits->set_max_candidates(kMaxCandidates);
  limits->set_max_frame_rate(kMaxOutputFps);
  FillLimits(serving_.calls.limits(), limits);
  limits->set_max_sleep_s(max_sleep_s_);
  int slots = 0;
  for (const Models::Use& scheduler : serving_.models.served()) {
    FromModel(scheduler->model(), response->add_models());
    slots += scheduler->stats().slots;
    for (const std::string& device : scheduler->devices()) {
      const auto& known = response->devices();
      if (std::find(known.begin(), known.end(), device) == known.end()) {
        response->add_devices(device);
      }
    }
  }
  response->set_slots(slots);
  response->set_active_streams(serving_.calls.count());
}

}  // namespace choreo
