#pragma once

#include <grpcpp/support/server_callback.h>

#include "server/calls/serving.h"

namespace choreo {

/// Makes the reactor that serves one StreamDance call. It deletes itself when the call is over.
grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* MakeStreamReactor(
    Serving& serving, grpc::CallbackServerContext* context);

}  // namespace choreo
