#pragma once

#include <grpcpp/support/server_callback.h>

#include "server/calls/serving.h"

namespace choreo {

/// Makes the reactor that serves one GenerateTransition call. It deletes itself when the call ends.
/// `request` must live until then.
grpc::ServerWriteReactor<grpc::ByteBuffer>* MakeTransitionReactor(
    Serving& serving, grpc::CallbackServerContext* context, const grpc::ByteBuffer* request);

}  // namespace choreo
