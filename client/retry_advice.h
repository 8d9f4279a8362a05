#pragma once

#include <grpcpp/support/status.h>

#include <string>

#include "model/core/error.h"

namespace choreo::client {

struct Options;

/// Converts a failed call's status to an error of its code, with its message, which names the
/// field.
Error ToError(const grpc::Status& status);

/// Whether the status means that no server was reached.
bool IsAway(const grpc::Status& status);

/// Converts a failed call's status to an error that explains more. `address`: one server's or
/// several, called with `options`. For unreachable servers, the message names them and suggests
/// which TLS option may be missing. For a full server, it names the server and when to retry.
Error ToError(const grpc::Status& status, const std::string& address, const Options& options);

/// The status if only a server of another fingerprint could restart a dance, with other frames.
/// Servers refuse a continuation with the same status; another server may accept it.
grpc::Status RefusedFingerprint(const std::string& begun, const std::string& address,
                                const std::string& found);

/// Where and when to retry a failed call.
struct RetryAdvice {
  bool here = false;       ///< at the same server
  bool elsewhere = false;  ///< at another one
  double wait_s = 0;       ///< least delay, from the server's RetryInfo
  bool leaving = false;    ///< the server is stopping, so another one should be tried at once
};

/// Returns how to retry a failed call. An unreachable or full server may be tried again. A server
/// that broke, has another fingerprint or lacks the model would fail again, but another may
/// succeed. Any other failure would recur everywhere.
RetryAdvice AdviceFor(const grpc::Status& status);

}  // namespace choreo::client
