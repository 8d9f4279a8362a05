#pragma once

#include "choreo/v1/choreography.grpc.pb.h"
#include "server/serving.h"

namespace choreo {

/// choreo.v1.Choreography. Its calls may run at any time, from gRPC's threads.
class ChoreographyService final : public v1::Choreography::CallbackService {
 public:
  ChoreographyService(Serving& serving, double max_sleep_s)
      : serving_(serving), max_sleep_s_(max_sleep_s) {}

  grpc::ServerWriteReactor<v1::GenerateTransitionResponse>* GenerateTransition(
      grpc::CallbackServerContext* context, const v1::GenerateTransitionRequest* request) override;
  grpc::ServerBidiReactor<v1::StreamDanceRequest, v1::StreamDanceResponse>* StreamDance(
      grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context,
                                          const v1::GetServerInfoRequest* request,
                                          v1::GetServerInfoResponse* response) override;

 private:
  Serving& serving_;
  const double max_sleep_s_;
};

}  // namespace choreo
