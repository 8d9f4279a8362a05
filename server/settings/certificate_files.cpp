#include "server/settings/certificate_files.h"

#include <spdlog/fmt/chrono.h>
#include <spdlog/spdlog.h>

#include <ctime>
#include <utility>

#include "model/core/error.h"
#include "network/pem.h"

namespace choreo {
namespace {

std::string Date(int64_t seconds) {
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

bool HasExpired(int64_t expires) { return expires <= std::time(nullptr); }

void RequireValid(const std::string& field, const std::filesystem::path& file, int64_t expires) {
  if (!HasExpired(expires)) return;
  throw InvalidArgument(field, file.string() + " expired on " + Date(expires));
}

}  // namespace

CertificateFiles::CertificateFiles(const ServerConfig& config)
    : certificate_(config.tls_certificate),
      key_(config.tls_key),
      client_ca_source_(config.tls_client_ca),
      needs_client_ca_(!config.tls_client_ca.empty()),
      used_(Read()),
      expires_(used_.expires),
      pair_(used_.pair),
      client_ca_(used_.client_ca) {}

CertificateFiles::Content CertificateFiles::Read() const {
  const KeyPair pair = ReadKeyPair("--tls-cert", certificate_, "--tls-key", key_);
  Content content{.pair = pair.certificates + '\n' + pair.key,
                  .expires = ExpiryOf(pair.certificates)};
  if (needs_client_ca_) {
    content.client_ca = ReadCertificates("--tls-client-ca", client_ca_source_);
    content.client_ca_expires = LatestExpiryOf(content.client_ca);
  }
  return content;
}

std::optional<bool> CertificateFiles::Refresh() {
  TellOfExpired();
  try {
    Content now = Read();
    const bool has_new_pair = now.pair != used_.pair,
               has_new_client_ca = now.client_ca != used_.client_ca;
    // An expired file already in use does not block the renewal of another.
    if (has_new_pair) RequireValid("--tls-cert", certificate_, now.expires);
    if (has_new_client_ca)
      RequireValid("--tls-client-ca", client_ca_source_, now.client_ca_expires);
    suspicion_.clear();
    const bool was_faulty = !std::exchange(fault_, "").empty();
    if (!has_new_pair && !has_new_client_ca) {
      if (!was_faulty) return std::nullopt;
      spdlog::info("the TLS files are those in use again, the certificate until {}",
                   Date(expires_));
      return true;
    }
    pair_.Replace(now.pair);
    client_ca_.Replace(now.client_ca);
    used_ = std::move(now);
    expires_ = used_.expires;
    if (has_new_pair) spdlog::info("--tls-cert: a new one is used, until {}", Date(expires_));
    if (has_new_client_ca)
      spdlog::info("--tls-client-ca: a new one is used, until {}", Date(used_.client_ca_expires));
    return true;
  } catch (const Error& error) {
    const std::string fault = error.what();
    const bool is_certain = fault == std::exchange(suspicion_, fault);
    if (!is_certain || fault == fault_) return std::nullopt;
    fault_ = fault;
    spdlog::error("{}; the former files stay in use, the certificate until {}", fault,
                  Date(expires_));
    return false;
  }
}

void CertificateFiles::TellOfExpired() {
  const auto tell = [](const char* field, int64_t expires, const char* effect, int64_t* told) {
    if (!HasExpired(expires) || std::exchange(*told, expires) == expires) return;
    spdlog::warn("{}: expired on {}; {}", field, Date(expires), effect);
  };
  tell("--tls-cert", expires_, "clients refuse it", &told_);
  if (needs_client_ca_)
    tell("--tls-client-ca", used_.client_ca_expires, "no client is admitted", &told_of_ca_);
}

void CertificateFiles::LogExpiry() {
  TellOfExpired();
  const auto log = [](const char* field, int64_t expires) {
    if (!HasExpired(expires)) spdlog::info("{}: valid until {}", field, Date(expires));
  };
  log("--tls-cert", expires_);
  if (needs_client_ca_) log("--tls-client-ca", used_.client_ca_expires);
}

}  // namespace choreo
