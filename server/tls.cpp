#include "server/tls.h"

#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>

#include "tls/pem.h"

namespace choreo {
namespace {

constexpr unsigned kRefreshSeconds = 1;

/// Finds errors that gRPC would only log when a client connects.
void CheckFiles(const ServerConfig& config) {
  ReadKeyPair("--tls-cert", config.tls_certificate, "--tls-key", config.tls_key);
  if (!config.tls_client_ca.empty()) ReadCertificates("--tls-client-ca", config.tls_client_ca);
}

}  // namespace

std::shared_ptr<grpc::ServerCredentials> MakeCredentials(const ServerConfig& config) {
  if (config.tls_certificate.empty()) return grpc::InsecureServerCredentials();
  CheckFiles(config);
  namespace tls = grpc::experimental;
  tls::TlsServerCredentialsOptions options(std::make_shared<tls::FileWatcherCertificateProvider>(
      config.tls_key.string(), config.tls_certificate.string(), config.tls_client_ca.string(),
      kRefreshSeconds));
  options.watch_identity_key_cert_pairs();
  if (!config.tls_client_ca.empty()) {
    options.watch_root_certs();
    options.set_cert_request_type(GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  }
  return tls::TlsServerCredentials(options);
}

}  // namespace choreo
