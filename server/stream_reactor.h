#pragma once

#include <grpcpp/support/server_callback.h>

#include "choreo/v1/choreography.pb.h"
#include "server/serving.h"

namespace choreo {

/// Serves one StreamDance; deletes itself when the call is over.
grpc::ServerBidiReactor<v1::StreamDanceRequest, v1::StreamDanceResponse>* MakeStreamReactor(
    Serving& serving, grpc::CallbackServerContext* context);

}  // namespace choreo
