#pragma once

#include <grpcpp/support/status.h>

#include <string>

#include "model/core/error.h"

namespace choreo::client {

/// What a failed call means here: its code, and its message, which names the field already.
Error ToError(const grpc::Status& status);

/// The same of a server that was asked at this address, with TLS or without: whoever is away is
/// named, and who may have wanted TLS.
Error ToError(const grpc::Status& status, const std::string& address, bool tls);

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
