#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "server/config.h"

namespace choreo {

/// How connections are secured. With TLS the files are read again while the server runs, so that
/// certificates can be renewed; new connections have the new ones, and fail while the files do not
/// go together. Throws Error(kInvalidArgument) naming the setting whose file can't be used.
std::shared_ptr<grpc::ServerCredentials> MakeCredentials(const ServerConfig& config);

}  // namespace choreo
