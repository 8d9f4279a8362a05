#include <utility>

#include "client/choreo_client.h"
#include "client/convert.h"
#include "client/dance_call.h"
#include "proto/wire/control_messages.h"

namespace choreo::client {

RemoteDance::RemoteDance(std::unique_ptr<DanceCall> call, const AudioFormat& audio)
    : call_(std::move(call)), audio_(audio) {}
RemoteDance::~RemoteDance() = default;

void RemoteDance::SendSamples(std::span<const float> interleaved) {
  if (audio_.kind != AudioKind::kPcmFloat || audio_.channels == 0 ||
      interleaved.size() % static_cast<size_t>(audio_.channels) != 0) {
    throw InvalidArgument("samples",
                          std::to_string(interleaved.size()) +
                              " values are not whole samples of this dance's audio format");
  }
  v1::StreamDanceRequest request;
  request.mutable_audio()->set_data(ToPcmBytes(interleaved));
  call_->Send(std::move(request));
}

void RemoteDance::SendBytes(std::span<const std::byte> bytes) {
  if (audio_.kind != AudioKind::kFile) {
    throw InvalidArgument("bytes", "this dance's audio is not a file");
  }
  v1::StreamDanceRequest request;
  request.mutable_audio()->set_data(bytes.data(), bytes.size());
  call_->Send(std::move(request));
}

void RemoteDance::EndAudio() {
  v1::StreamDanceRequest request;
  request.mutable_end_of_audio();
  call_->Send(std::move(request));
}

void RemoteDance::SendKey(const KeyPose& key) {
  v1::StreamDanceRequest request;
  *request.mutable_keyframe() = ToProto(key);
  call_->Send(std::move(request));
}

void RemoteDance::RemoveKey(const std::string& id) {
  v1::StreamDanceRequest request;
  request.mutable_remove_keyframe()->set_id(id);
  call_->Send(std::move(request));
}

void RemoteDance::SendControls(const ControlRequest& controls) {
  v1::StreamDanceRequest request;
  *request.mutable_controls() = wire::ToProto(controls);
  call_->Send(std::move(request));
}

void RemoteDance::GenerateUntil(int64_t frame) {
  v1::StreamDanceRequest request;
  request.mutable_generate_until()->set_frame(frame);
  call_->Send(std::move(request));
}

void RemoteDance::SendBeats(std::span<const double> seconds, std::span<const double> downbeats,
                            std::optional<double> confidence) {
  v1::StreamDanceRequest request;
  v1::MusicBeats& beats = *request.mutable_music_beats();
  beats.mutable_times()->Add(seconds.begin(), seconds.end());
  beats.mutable_downbeats()->Add(downbeats.begin(), downbeats.end());
  if (confidence) beats.set_confidence(*confidence);
  call_->Send(std::move(request));
}

void RemoteDance::SendPassages(std::span<const Passage> passages) {
  v1::StreamDanceRequest request;
  for (const Passage& passage : passages)
    *request.mutable_music_passages()->add_passages() = ToProto(passage);
  call_->Send(std::move(request));
}

void RemoteDance::CompleteKeys() {
  v1::StreamDanceRequest request;
  request.mutable_keyframes_complete();
  call_->Send(std::move(request));
}

std::optional<Message> RemoteDance::Next() {
  const std::optional<DanceCall::Answer> answer = call_->Next();
  if (!answer) return std::nullopt;
  if (const auto* resumed = std::get_if<Resumed>(&*answer)) return *resumed;
  const auto& response = std::get<v1::StreamDanceResponse>(*answer);
  if (response.has_header()) {
    Header header = FromProto(response.header());
    joints_ = header.skeleton.joints();
    return header;
  }
  if (response.has_frames()) return FromProto(response.frames(), joints_);
  if (response.has_continuation()) return FromProto(response.continuation());
  if (response.has_summary())
    return FromProto(response.summary().report(), response.summary().timing());
  return std::visit([](const auto& said) { return Message(said); },
                    FromProto(response.event()).value());
}

void RemoteDance::Cancel() noexcept { call_->Cancel(); }

DanceCall& CallOf(RemoteDance& dance) { return *dance.call_; }

}  // namespace choreo::client
