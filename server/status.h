#pragma once

#include <grpcpp/support/status.h>

#include <string>

#include "model/core/error.h"

namespace choreo {

/// The only place that maps failures to gRPC statuses. The status carries google.rpc details:
/// always ErrorInfo with the error's field, and its key's id (MessageError); BadRequest if there is
/// a field, with its path in the sent message and a description that does not repeat it; RetryInfo,
/// `retry_after` seconds, if retrying helps.
grpc::Status ToStatus(const Error& error, double retry_after = 1);

/// What is wrong with a message: the field's path in it, and a description that does not repeat it.
/// Both are short lines.
struct Violation {
  std::string field, description;
};
Violation ViolationOf(const Error& error);

/// The status for unknown callers. Includes ErrorInfo.
grpc::Status Unauthenticated(const std::string& message);

/// The usual name: "RESOURCE_EXHAUSTED".
const char* NameOf(grpc::StatusCode code);

}  // namespace choreo
