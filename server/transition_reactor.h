#pragma once

#include <grpcpp/support/server_callback.h>

#include "choreo/v1/choreography.pb.h"
#include "server/serving.h"

namespace choreo {

/// Serves one GenerateTransition; deletes itself when the call is over. `request` lives as long.
grpc::ServerWriteReactor<v1::GenerateTransitionResponse>* MakeTransitionReactor(
    Serving& serving, grpc::CallbackServerContext* context,
    const v1::GenerateTransitionRequest* request);

}  // namespace choreo
