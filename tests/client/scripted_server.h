#pragma once

#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/server_builder.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "choreo/v1/choreography.grpc.pb.h"
#include "model/motion/skeleton.h"
#include "proto/wire/convert.h"

namespace choreo {

/// A server in this process, on a free port, whose dances a test answers.
class ScriptedServer final : public v1::Choreography::Service {
 public:
  using Stream = grpc::ServerReaderWriter<v1::StreamDanceResponse, v1::StreamDanceRequest>;
  using Script = std::function<grpc::Status(Stream&)>;

  /// Each dance calls `script`, on a thread of its own.
  explicit ScriptedServer(Script script, v1::GetServerInfoResponse info = {})
      : script_(std::move(script)), info_(std::move(info)) {
    grpc::EnableDefaultHealthCheckService(true);
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
    server_->GetHealthCheckService()->SetServingStatus("choreo.v1.Choreography", true);
  }

  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  /// The least header that clients take.
  static v1::StreamDanceResponse Header() {
    v1::StreamDanceResponse response;
    *response.mutable_header()->mutable_skeleton() = wire::ToProto(Skeleton::Smpl24());
    response.mutable_header()->set_frame_rate(30);
    response.mutable_header()->set_model_frame_rate(30);
    return response;
  }

 private:
  grpc::Status StreamDance(grpc::ServerContext*, Stream* stream) override {
    return script_(*stream);
  }
  grpc::Status GetServerInfo(grpc::ServerContext*, const v1::GetServerInfoRequest*,
                             v1::GetServerInfoResponse* response) override {
    *response = info_;
    return grpc::Status::OK;
  }

  const Script script_;
  const v1::GetServerInfoResponse info_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

/// Adds a field of a later version.
inline void AddUnknownField(google::protobuf::Message* message) {
  message->GetReflection()->MutableUnknownFields(message)->AddVarint(1000, 7);
}

}  // namespace choreo
