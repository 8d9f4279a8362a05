#pragma once

#include <grpcpp/support/server_callback.h>

#include "server/serving.h"

namespace choreo {

/// Serves one GenerateTransition; deletes itself when the call ends. `request` must live as long.
grpc::ServerWriteReactor<grpc::ByteBuffer>* MakeTransitionReactor(
    Serving& serving, grpc::CallbackServerContext* context, const grpc::ByteBuffer* request);

}  // namespace choreo
