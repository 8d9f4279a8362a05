#pragma once

#include <grpcpp/support/status.h>

#include "model/core/error.h"

namespace choreo {

/// The one place that maps failures onto gRPC statuses. The status carries google.rpc details:
/// ErrorInfo always; BadRequest where the error names a field; RetryInfo, `retry_after` seconds,
/// where trying again helps.
grpc::Status ToStatus(const Error& error, double retry_after = 1);

}  // namespace choreo
