#pragma once

#include <grpcpp/support/server_callback.h>

#include "server/serving.h"

namespace choreo {

/// Serves one StreamDance; deletes itself when the call is over.
grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* MakeStreamReactor(
    Serving& serving, grpc::CallbackServerContext* context);

}  // namespace choreo
