#pragma once

#include <grpcpp/support/status.h>

#include "model/core/error.h"

namespace choreo::client {

/// What a failed call means here: its code, and its message, which names the field already.
Error ToError(const grpc::Status& status);

/// How a call that failed may be tried again.
struct RetryAdvice {
  bool here = false;       ///< at the same server
  bool elsewhere = false;  ///< at another one
  double wait_s = 0;       ///< at least; from the server's RetryInfo
};

/// A server that is away or full may be asked again. One that broke, is of another fingerprint or
/// lacks the model would fail again, but another one may do better. Anything else fails everywhere.
RetryAdvice AdviceFor(const grpc::Status& status);

}  // namespace choreo::client
