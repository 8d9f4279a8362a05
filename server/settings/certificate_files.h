#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "server/process/memory_file.h"
#include "server/settings/config.h"

namespace choreo {

/// The certificate, key and client CA that a server uses: the last valid versions of the files in
/// its settings. gRPC reads copies, because it reloads files without checks. Not thread-safe.
class CertificateFiles {
 public:
  /// Throws Error(kInvalidArgument) naming the setting of an unusable file.
  explicit CertificateFiles(const ServerConfig& config);

  /// Rereads the files; call regularly. Returns whether a change was usable, or none without a
  /// change. Reports a fault once it has seen it twice: files that are replaced one by one do not
  /// match for a moment. Logs changes and faults once, and once that a file in use has expired. An
  /// expired certificate does not replace another.
  std::optional<bool> Refresh();

  /// The certificate chain and the key, in one file so that they always match.
  std::filesystem::path pair() const { return pair_.path(); }
  /// Empty if clients need no certificate.
  std::filesystem::path client_ca() const {
    return needs_client_ca_ ? client_ca_.path() : std::filesystem::path();
  }
  int64_t expires() const { return expires_; }  ///< the certificate's end; seconds since 1970
  /// When the last client CA expires: from then on no client is admitted. Seconds since 1970; 0 if
  /// clients need no certificate.
  int64_t client_ca_expires() const { return used_.client_ca_expires; }
  /// Logs when each file expires, as a warning if it has expired. A server with an expired file
  /// starts, too: it may be renewed.
  void LogExpiry();

 private:
  struct Content {
    std::string pair, client_ca = {};
    int64_t expires = 0, client_ca_expires = 0;
    bool operator==(const Content&) const = default;
  };
  Content Read() const;
  /// Logs once that a file in use has expired.
  void TellOfExpired();

  const std::filesystem::path certificate_, key_, client_ca_source_;
  const bool needs_client_ca_;
  Content used_;
  int64_t expires_;
  MemoryFile pair_, client_ca_;
  std::string suspicion_, fault_;      // seen at the last Refresh; reported
  int64_t told_ = 0, told_of_ca_ = 0;  // the reported expiries of files in use
};

}  // namespace choreo
