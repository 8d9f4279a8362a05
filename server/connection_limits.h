#pragma once

#include <grpcpp/server_builder.h>

#include "server/settings/config.h"

namespace choreo {

/// The number of concurrent calls that gRPC allows per connection.
int CallsOfConnection(const ServerConfig& config);

/// Limits clients at the transport: bytes in transit, calls per connection, threads of gRPC's
/// reflection and idle time. Refuses compressed requests, which gRPC 1.51 would inflate before
/// checking their size. Reads max_streams and max_network_mib.
void LimitConnections(const ServerConfig& config, grpc::ServerBuilder* builder);

}  // namespace choreo
