#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "tests/support/shell.h"

namespace choreo {

/// PEM files of a certificate and its key.
struct Certificate {
  std::filesystem::path certificate, key;
};

/// A certificate authority, whose certificates are valid for a day. All files are in one folder.
class Authority {
 public:
  Authority(std::filesystem::path folder, const std::string& name)
      : folder_(std::move(folder)), ca_{folder_ / (name + ".pem"), folder_ / (name + ".key")} {
    Run("openssl req -x509 -subj /CN=" + name + " -days 1 -keyout " + ca_.key.string() + " -out " +
        ca_.certificate.string() + kNewKey);
  }

  const std::filesystem::path& certificate() const { return ca_.certificate; }

  /// Issues a certificate for localhost and 127.0.0.1.
  Certificate Issue(const std::string& name) const {
    const Certificate issued{folder_ / (name + ".pem"), folder_ / (name + ".key")};
    Run("openssl req -x509 -subj /CN=" + name + " -days 1 -CA " + ca_.certificate.string() +
        " -CAkey " + ca_.key.string() +
        " -addext subjectAltName=DNS:localhost,IP:127.0.0.1 -addext basicConstraints=CA:FALSE"
        " -keyout " +
        issued.key.string() + " -out " + issued.certificate.string() + kNewKey);
    return issued;
  }

  /// Issues a certificate that expired yesterday.
  Certificate IssueExpired(const std::string& name) const {
    const Certificate issued{folder_ / (name + ".pem"), folder_ / (name + ".key")};
    const std::string request = (folder_ / (name + ".csr")).string();
    Run("openssl req -new -subj /CN=" + name + " -keyout " + issued.key.string() + " -out " +
        request + kNewKey);
    Run("openssl x509 -req -days -1 -in " + request + " -CA " + ca_.certificate.string() +
        " -CAkey " + ca_.key.string() + " -out " + issued.certificate.string());
    return issued;
  }

 private:
  static constexpr const char* kNewKey = " -newkey ec -pkeyopt ec_paramgen_curve:P-256 -noenc";

  static void Run(const std::string& command) {
    const Outcome outcome = Shell(command);
    EXPECT_EQ(outcome.code, 0) << command << '\n' << outcome.said;
  }

  const std::filesystem::path folder_;
  const Certificate ca_;
};

}  // namespace choreo
