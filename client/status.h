#pragma once

#include <grpcpp/support/status.h>

#include "model/core/error.h"

namespace choreo::client {

/// What a failed call means here: its code, and its message, which names the field already.
Error ToError(const grpc::Status& status);

/// How a call that failed may be tried again.
struct RetryAdvice {
  bool retry = false;
  double wait_s = 0;  ///< at least; from the server's RetryInfo
};

/// A server that is away or full may be asked again; anything else would only fail again.
RetryAdvice AdviceFor(const grpc::Status& status);

}  // namespace choreo::client
