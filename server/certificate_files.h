#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "server/config.h"
#include "server/memory_file.h"

namespace choreo {

/// The certificate, its key and the clients' authorities that a server uses: the last good versions
/// of the files in its settings. gRPC rereads its files unchecked, so it reads copies of these.
/// Not thread-safe.
class CertificateFiles {
 public:
  /// Throws Error(kInvalidArgument) naming the setting of an unusable file.
  explicit CertificateFiles(const ServerConfig& config);

  /// Rereads the files; call regularly. Returns whether a change could be used; none without a
  /// change. A fault counts once it was seen twice: files that are replaced one by one do not match
  /// for a moment. Logs both once. Expired certificates do not replace others.
  std::optional<bool> Refresh();

  /// The certificates and the key, in one file so that they always match.
  std::filesystem::path pair() const { return pair_.path(); }
  /// Empty if clients need no certificate.
  std::filesystem::path client_ca() const {
    return needs_client_ca_ ? client_ca_.path() : std::filesystem::path();
  }
  int64_t expires() const { return expires_; }  ///< of the certificate; seconds since 1970
  /// When no client can be admitted any more; 0 if clients need no certificate.
  int64_t client_ca_expires() const { return used_.client_ca_expires; }
  /// Throws Error(kInvalidArgument) for an expired file.
  void RequireUnexpired() const;
  /// Logs until when each file is valid; a warning if it has expired.
  void LogExpiry() const;

 private:
  struct Content {
    std::string pair, client_ca = {};
    int64_t expires = 0, client_ca_expires = 0;
    bool operator==(const Content&) const = default;
  };
  Content Read() const;

  const std::filesystem::path certificate_, key_, client_ca_source_;
  const bool needs_client_ca_;
  Content used_;
  int64_t expires_;
  MemoryFile pair_, client_ca_;
  std::string suspicion_, fault_;  // seen at the last look; reported
};

}  // namespace choreo
