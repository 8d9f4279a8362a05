#pragma once

#include <grpcpp/server_builder.h>

#include "server/config.h"

namespace choreo {

/// How many calls of a connection gRPC lets in at once.
int CallsOfConnection(const ServerConfig& config);

/// Bounds what clients may take of the server before one of its calls sees them: bytes on their
/// way, calls of one connection, time without a word; and refuses compressed requests, which gRPC
/// 1.51 would inflate before it looks at their size. Reads max_streams and max_network_mib.
void LimitConnections(const ServerConfig& config, grpc::ServerBuilder* builder);

}  // namespace choreo
