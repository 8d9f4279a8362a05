#pragma once

#include <map>
#include <mutex>
#include <string>

#include "choreo/v1/choreography.grpc.pb.h"
#include "server/calls/serving.h"

namespace choreo {

/// Implements choreo.v1.Choreography. gRPC may call it on any of its threads at any time. Requests
/// of the two calls that dance arrive as raw bytes, which ReadMessage checks before parsing.
class ChoreographyService final
    : public v1::Choreography::WithRawCallbackMethod_GenerateTransition<
          v1::Choreography::WithRawCallbackMethod_StreamDance<
              v1::Choreography::WithCallbackMethod_GetServerInfo<v1::Choreography::Service>>> {
 public:
  explicit ChoreographyService(Serving& serving) : serving_(serving) {}

  grpc::ServerWriteReactor<grpc::ByteBuffer>* GenerateTransition(
      grpc::CallbackServerContext* context, const grpc::ByteBuffer* request) override;
  grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* StreamDance(
      grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const v1::GetServerInfoRequest* request,
                                          v1::GetServerInfoResponse* response) override;

 private:
  class InfoReactor;

  void Describe(v1::GetServerInfoResponse* response) const;

  Serving& serving_;
  std::mutex mutex_;
  std::map<std::string, int> unread_infos_;  // unread answers by address, above 0. Lock: mutex_
};

}  // namespace choreo
