#include "server/tls.h"

#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>
#include <openssl/err.h>
#include <openssl/ssl.h>

#include "model/core/error.h"

namespace choreo {
namespace {

constexpr unsigned kRefreshSeconds = 1;

/// What gRPC would only write to its own log, once a client comes.
void CheckFiles(const ServerConfig& config) {
  const auto refuse = [](const char* setting, const std::filesystem::path& file) {
    const char* why = ERR_reason_error_string(ERR_get_error());
    ERR_clear_error();
    throw InvalidArgument(setting, file.string() + " cannot be used: " +
                                       (why == nullptr ? "no PEM file of this kind" : why));
  };
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_server_method()),
                                                                  SSL_CTX_free);
  ERR_clear_error();
  if (SSL_CTX_use_certificate_chain_file(context.get(), config.tls_certificate.c_str()) != 1) {
    refuse("--tls-cert", config.tls_certificate);
  }
  if (SSL_CTX_use_PrivateKey_file(context.get(), config.tls_key.c_str(), SSL_FILETYPE_PEM) != 1) {
    refuse("--tls-key", config.tls_key);
  }
  if (config.tls_client_ca.empty()) return;
  if (SSL_CTX_load_verify_file(context.get(), config.tls_client_ca.c_str()) != 1) {
    refuse("--tls-client-ca", config.tls_client_ca);
  }
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
