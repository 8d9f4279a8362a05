#pragma once

#include <grpcpp/support/status.h>

#include <string>

#include "model/core/error.h"

namespace choreo {

/// The one place that maps failures onto gRPC statuses. The status carries google.rpc details:
/// ErrorInfo always, with the error's field; BadRequest where there is one, whose own is the path
/// in the message that was sent, and whose description does not repeat it; RetryInfo, `retry_after`
/// seconds, where trying again helps.
grpc::Status ToStatus(const Error& error, double retry_after = 1);

/// Who calls is not known. ErrorInfo goes with it.
grpc::Status Unauthenticated(const std::string& message);

/// As people know it: "RESOURCE_EXHAUSTED".
const char* NameOf(grpc::StatusCode code);

}  // namespace choreo
