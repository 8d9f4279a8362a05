#include "server/certificate_files.h"

#include <spdlog/fmt/chrono.h>
#include <spdlog/spdlog.h>

#include <ctime>
#include <utility>

#include "model/core/error.h"
#include "tls/pem.h"

namespace choreo {
namespace {

std::string Date(int64_t seconds) {
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

bool HasExpired(int64_t expires) { return expires <= std::time(nullptr); }

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
  if (needs_client_ca_) content.client_ca = ReadCertificates("--tls-client-ca", client_ca_source_);
  return content;
}

std::optional<bool> CertificateFiles::Refresh() {
  try {
    Content now = Read();
    const bool is_new = now != used_;
    if (is_new && HasExpired(now.expires)) {
      throw InvalidArgument("--tls-cert",
                            certificate_.string() + " expired on " + Date(now.expires));
    }
    suspicion_.clear();
    const bool was_faulty = !std::exchange(fault_, "").empty();
    if (!is_new) return was_faulty ? std::optional(true) : std::nullopt;
    pair_.Replace(now.pair);
    client_ca_.Replace(now.client_ca);
    used_ = std::move(now);
    expires_ = used_.expires;
    spdlog::info("a new certificate is used, until {}", Date(expires_));
    return true;
  } catch (const Error& error) {
    const std::string fault = error.what();
    const bool is_certain = fault == std::exchange(suspicion_, fault);
    if (!is_certain || fault == fault_) return std::nullopt;
    fault_ = fault;
    spdlog::error("{}; the former certificate is used on, until {}", fault, Date(expires_));
    return false;
  }
}

void WarnIfExpired(int64_t expires) {
  if (!HasExpired(expires)) return;
  spdlog::warn("--tls-cert: expired on {}; clients refuse it", Date(expires));
}

}  // namespace choreo
