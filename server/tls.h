#pragma once

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "server/certificate_files.h"

namespace choreo {

/// Makes the credentials of connections; null `files`: without TLS. New connections use the files'
/// versions of a second ago. The files must outlive the server.
std::shared_ptr<grpc::ServerCredentials> MakeCredentials(const CertificateFiles* files);

}  // namespace choreo
