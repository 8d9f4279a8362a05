#include "tests/fuzz/rpc.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/proto_buffer_reader.h>
#include <grpcpp/support/sync_stream.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "tests/support/fake_sampler.h"

namespace choreo::fuzz {
namespace {

// Under sanitizers and on a busy machine.
constexpr std::chrono::seconds kPatience{20};

using Stream = grpc::ClientReaderWriter<grpc::ByteBuffer, grpc::ByteBuffer>;

/// Whether an input may make a call end like this.
bool IsAnAnswer(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::OK:
    case grpc::StatusCode::INVALID_ARGUMENT:
    case grpc::StatusCode::OUT_OF_RANGE:
    case grpc::StatusCode::NOT_FOUND:
    case grpc::StatusCode::UNIMPLEMENTED:
    case grpc::StatusCode::FAILED_PRECONDITION:
      return true;
    default:
      return false;
  }
}

}  // namespace

RpcServer::RpcServer() {
  spdlog::set_level(spdlog::level::off);
  ServerConfig config;
  config.listen = "127.0.0.1:0";
  config.max_load = 2;  // however slow the machine is
  std::vector<Server::Samplers> models;
  models.emplace_back().push_back(std::make_unique<ControlledSampler>());
  server_ = std::make_unique<Server>(config, std::move(models));
  channel_ = grpc::CreateChannel("127.0.0.1:" + std::to_string(server_->port()),
                                 grpc::InsecureChannelCredentials());
}

void RpcServer::ExpectIdle() const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (server_->calls() != 0 || server_->transitions() != 0) {
    if (std::chrono::steady_clock::now() > end) Fail("a call is over, but not what it had");
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

struct RawStream::Call {
  std::unique_ptr<Stream> stream;
};

RawStream::RawStream(RpcServer& server, const std::string& method) : server_(server) {
  context_.set_deadline(std::chrono::system_clock::now() + kPatience);
  const std::string path = "/choreo.v1.Choreography/" + method;
  const grpc::internal::RpcMethod rpc(path.c_str(), grpc::internal::RpcMethod::BIDI_STREAMING,
                                      server.channel());
  call_ = std::make_unique<Call>();
  call_->stream.reset(
      grpc::internal::ClientReaderWriterFactory<grpc::ByteBuffer, grpc::ByteBuffer>::Create(
          server.channel().get(), rpc, &context_));
}

RawStream::~RawStream() = default;

bool RawStream::Send(const std::string& bytes) {
  const grpc::Slice slice(bytes);
  return call_->stream->Write(grpc::ByteBuffer(&slice, 1));
}

bool RawStream::Read(google::protobuf::Message* answer) {
  grpc::ByteBuffer bytes;
  if (!call_->stream->Read(&bytes)) return false;
  grpc::ProtoBufferReader reader(&bytes);
  if (!answer->ParseFromZeroCopyStream(&reader)) Fail("an answer is no message");
  return true;
}

void RawStream::Cancel() {
  cancelled_ = true;
  context_.TryCancel();
}

void RawStream::HalfClose() { call_->stream->WritesDone(); }

void RawStream::CheckEnd() {
  const grpc::Status status = call_->stream->Finish();
  const bool long_dance = status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED && frames_ > 0;
  const bool cancelled = cancelled_ && status.error_code() == grpc::StatusCode::CANCELLED;
  if (!IsAnAnswer(status.error_code()) && !long_dance && !cancelled) {
    std::fprintf(stderr, "status %d: ", static_cast<int>(status.error_code()));
    Fail(status.error_message().c_str());
  }
  server_.ExpectIdle();
}

v1::Pose GoodPose(double x, float elbow) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  v1::Pose pose;
  pose.mutable_root_position()->set_x(x);
  pose.mutable_root_position()->set_y(skeleton.pelvis_height);
  pose.mutable_root_position()->set_z(0.4);
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    pose.add_rotations(0);
    pose.add_rotations(joint == skeleton.left_elbow ? elbow : 0);
    pose.add_rotations(0);
  }
  return pose;
}

std::string GoodMusic(size_t samples) {
  std::string bytes;
  for (size_t i = 0; i < samples; ++i) {
    const auto sample = static_cast<int16_t>(std::lround(8000 * std::sin(0.06 * i)));
    bytes += static_cast<char>(sample & 0xFF);
    bytes += static_cast<char>((sample >> 8) & 0xFF);
  }
  return bytes;
}

v1::AudioFormat GoodFormat() {
  v1::AudioFormat format;
  format.set_encoding(v1::AUDIO_ENCODING_PCM_S16LE);
  format.set_sample_rate(22'050);
  format.set_channels(1);
  return format;
}

}  // namespace choreo::fuzz
