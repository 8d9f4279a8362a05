#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "server/config.h"

namespace choreo {

/// Credentials of connections. With TLS the files are reread while the server runs, so that
/// certificates can be renewed; new connections use the new ones, and fail while the files do not
/// match. Throws Error(kInvalidArgument) naming the setting of an unusable file.
std::shared_ptr<grpc::ServerCredentials> MakeCredentials(const ServerConfig& config);

}  // namespace choreo
