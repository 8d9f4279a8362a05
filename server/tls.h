#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "server/settings/certificate_files.h"

namespace choreo {

/// Makes the server's credentials; without TLS if `files` is null. New connections use the files as
/// they were at most a second ago. `files` must outlive the server.
std::shared_ptr<grpc::ServerCredentials> MakeCredentials(const CertificateFiles* files);

}  // namespace choreo
