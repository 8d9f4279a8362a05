#pragma once

#include <grpcpp/support/status.h>

#include <string>

#include "model/core/error.h"

namespace choreo::client {

struct Options;

/// Converts a failed call's status to an error: its code, and its message, which already names the
/// field.
Error ToError(const grpc::Status& status);

/// Whether no server was reached.
bool IsAway(const grpc::Status& status);

/// The same for a server at this address, or servers at several, called with these options: names
/// unreachable servers, what of TLS they may miss, and a full one, with when to come again.
Error ToError(const grpc::Status& status, const std::string& address, const Options& options);

/// The error for a restarted dance on a server of another fingerprint, which would make other
/// frames. Servers refuse a continuation in the same way; another one may do better.
grpc::Status RefusedFingerprint(const std::string& begun, const std::string& address,
                                const std::string& found);

/// How to retry a failed call.
struct RetryAdvice {
  bool here = false;       ///< at the same server
  bool elsewhere = false;  ///< at another one
  double wait_s = 0;       ///< at least; from the server's RetryInfo
};

/// An unreachable or full server may be asked again. One that broke, has another fingerprint or
/// lacks the model would fail again, but another may do better. Anything else fails everywhere.
RetryAdvice AdviceFor(const grpc::Status& status);

}  // namespace choreo::client
