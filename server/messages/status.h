#pragma once

#include <grpcpp/support/status.h>

#include <string>

#include "model/core/error.h"

namespace choreo {

/// Maps an error to a gRPC status; the only place that does so. The status carries google.rpc
/// details: always ErrorInfo with the error's field and its key's id (MessageError); with a field,
/// BadRequest with its path in the sent message and a description without the path; if a retry
/// helps, RetryInfo with `retry_after` seconds.
grpc::Status ToStatus(const Error& error, double retry_after = 1);

/// A fault in a message: the field's path, and a description that does not repeat the path. Both
/// are short lines.
struct Violation {
  std::string field, description;
};
Violation ViolationOf(const Error& error);

/// The status for unknown callers, with ErrorInfo. `renewable`: clients may come back at once with
/// another token, which RetryInfo says.
grpc::Status Unauthenticated(const std::string& message, bool renewable = false);

/// The usual name of a status code, such as "RESOURCE_EXHAUSTED".
const char* NameOf(grpc::StatusCode code);

}  // namespace choreo
