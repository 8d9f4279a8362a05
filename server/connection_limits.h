#pragma once

#include <grpcpp/server_builder.h>

#include "server/config.h"

namespace choreo {

/// How many concurrent calls gRPC allows per connection.
int CallsOfConnection(const ServerConfig& config);

/// Limits clients before their calls are seen: bytes in transit, calls per connection, idle time;
/// and refuses compressed requests, which gRPC 1.51 would inflate before checking their size. Reads
/// max_streams and max_network_mib.
void LimitConnections(const ServerConfig& config, grpc::ServerBuilder* builder);

}  // namespace choreo
