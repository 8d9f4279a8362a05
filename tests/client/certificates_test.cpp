#include <gmock/gmock.h>
#include <sys/stat.h>

#include <ctime>
#include <fstream>
#include <sstream>

#include "server/settings/certificate_files.h"
#include "tests/client/security_fixture.h"
#include "tests/support/expect_error.h"

/// Files of certificates: renewed, expired, unusable.
namespace choreo::client::certificates_test {

using testing::HasSubstr;
using testing::Not;

TEST_F(TlsTest, ARenewedCertificateIsShownWithoutARestart) {
  const Certificate own = authority_.Issue("own");
  const auto server = Start([&](ServerConfig& config) { Serve(own, config); });
  const Client before(Trusting(*server, authority_));
  const auto dance = before.StartDance({.frames = 100});
  ASSERT_TRUE(dance->Next());
  // For a moment key and certificate do not match, as when files are copied one by one.
  const Certificate renewed = stranger_.Issue("renewed");
  std::filesystem::copy(renewed.key, own.key, std::filesystem::copy_options::overwrite_existing);
  EXPECT_TRUE(Serves(Trusting(*server, authority_)));
  std::filesystem::copy(renewed.certificate, own.certificate,
                        std::filesystem::copy_options::overwrite_existing);
  ExpectEventually([&] { return Serves(Trusting(*server, stranger_)); }, "the new one is shown");
  // The dance continues over its connection.
  dance->CompleteKeys();
  while (dance->Next()) {
  }
}

TEST_F(TlsTest, ABadRenewalKeepsTheLastGoodPair) {
  const LogCapture log;
  const Certificate own = authority_.Issue("own");
  ServerConfig config;
  Serve(own, config);
  CertificateFiles files(config);
  const auto content = [&] {
    std::ostringstream text;
    text << std::ifstream(files.pair()).rdbuf();
    return text.str();
  };
  const std::string before = content();
  EXPECT_THAT(before, HasSubstr("BEGIN CERTIFICATE"));
  EXPECT_THAT(before, HasSubstr("PRIVATE KEY"));
  EXPECT_NEAR(static_cast<double>(files.expires()),
              static_cast<double>(std::time(nullptr)) + 86'400, 3'600);
  EXPECT_EQ(files.Refresh(), std::nullopt);
  const auto replace = [](const std::filesystem::path& by, const std::filesystem::path& what) {
    std::filesystem::copy(by, what, std::filesystem::copy_options::overwrite_existing);
  };
  const Certificate renewed = authority_.Issue("renewed"), late = authority_.IssueExpired("late");
  replace(renewed.key, own.key);
  EXPECT_EQ(files.Refresh(), std::nullopt) << "the certificate may be on its way";
  EXPECT_EQ(files.Refresh(), false);
  EXPECT_EQ(files.Refresh(), std::nullopt) << "this was told";
  EXPECT_EQ(content(), before);
  replace(renewed.certificate, own.certificate);
  EXPECT_EQ(files.Refresh(), true);
  const std::string after = content();
  EXPECT_NE(after, before);
  replace(late.certificate, own.certificate);
  replace(late.key, own.key);
  files.Refresh();
  EXPECT_EQ(files.Refresh(), false) << "it has expired";
  EXPECT_EQ(content(), after);
  replace(renewed.certificate, own.certificate);
  replace(renewed.key, own.key);
  EXPECT_EQ(files.Refresh(), true);
  EXPECT_THAT(log.text(),
              HasSubstr("[info] the TLS files are those in use again, the certificate until 20"));
}

TEST_F(TlsTest, AnExpiredCertificateIsTold) {
  const LogCapture log;
  const Certificate late = authority_.IssueExpired("late");
  const auto server = Start([&](ServerConfig& config) { Serve(late, config); });
  EXPECT_THAT(log.text(), HasSubstr("--tls-cert: expired on "));
}

TEST_F(TlsTest, AFileThatExpiresInUseIsToldOnce) {
  const LogCapture log;
  const Certificate late = authority_.IssueExpired("late");
  ServerConfig config;
  Serve(late, config);
  config.tls_client_ca = late.certificate;
  CertificateFiles files(config);
  EXPECT_EQ(log.text(), "");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(files.Refresh(), std::nullopt);
  for (const std::string setting : {"--tls-cert", "--tls-client-ca"}) {
    const size_t at = log.text().find("[warning] " + setting + ": expired on 20");
    EXPECT_NE(at, std::string::npos);
    EXPECT_EQ(log.text().find(setting + ": ", at + 20), std::string::npos) << "told once";
  }
}

TEST_F(TlsTest, TheStartTellsHowLongFilesAreValid) {
  const LogCapture log;
  const Certificate own = authority_.Issue("own");
  const auto server = Start([&](ServerConfig& config) {
    Serve(own, config);
    config.tls_client_ca = authority_.certificate();
  });
  EXPECT_THAT(log.text(), HasSubstr("[info] --tls-cert: valid until 20"));
  EXPECT_THAT(log.text(), HasSubstr("[info] --tls-client-ca: valid until 20"));
}

TEST_F(TlsTest, AnExpiredClientAuthorityIsTold) {
  const LogCapture log;
  const Certificate own = authority_.Issue("own"), late = authority_.IssueExpired("late");
  const auto server = Start([&](ServerConfig& config) {
    Serve(own, config);
    config.tls_client_ca = late.certificate;
  });
  EXPECT_THAT(log.text(), HasSubstr("[warning] --tls-client-ca: expired on 20"));
  EXPECT_THAT(log.text(), Not(HasSubstr("--tls-cert: expired")));
}

TEST_F(TlsTest, AnExpiredClientAuthorityReplacesNoOther) {
  const LogCapture log;
  const Certificate own = authority_.Issue("own"), late = authority_.IssueExpired("late");
  const std::filesystem::path ca = folder_ / "clients.pem";
  ServerConfig config;
  Serve(own, config);
  config.tls_client_ca = ca;
  const auto content = [](const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  };
  const auto write = [&](const std::string& text) { std::ofstream(ca) << text; };
  const std::string valid = content(authority_.certificate()), expired = content(late.certificate);
  write(valid);
  CertificateFiles files(config);
  write(expired);
  EXPECT_EQ(files.Refresh(), std::nullopt) << "a fault counts when it was seen twice";
  EXPECT_EQ(files.Refresh(), false);
  EXPECT_EQ(content(files.client_ca()), valid);
  EXPECT_THAT(log.text(), HasSubstr("[error] --tls-client-ca: " + ca.string() + " expired on 20"));
  // One of several authorities may have expired.
  write(expired + valid);
  EXPECT_EQ(files.Refresh(), true);
  EXPECT_EQ(content(files.client_ca()), expired + valid);
  EXPECT_THAT(log.text(), HasSubstr("[info] --tls-client-ca: a new one is used, until 20"));
  EXPECT_THAT(log.text(), Not(HasSubstr("--tls-cert: a new one")));
}

// An authority that expired in use stays, and the certificate can still be renewed.
TEST_F(TlsTest, ACertificateIsRenewedBesideAnExpiredClientAuthority) {
  const LogCapture log;
  const Certificate own = authority_.Issue("own"), renewed = authority_.Issue("renewed"),
                    late = authority_.IssueExpired("late");
  ServerConfig config;
  Serve(own, config);
  config.tls_client_ca = late.certificate;
  CertificateFiles files(config);
  std::filesystem::rename(renewed.certificate, own.certificate);
  std::filesystem::rename(renewed.key, own.key);
  EXPECT_EQ(files.Refresh(), true);
  EXPECT_THAT(log.text(), HasSubstr("[info] --tls-cert: a new one is used, until 20"));
  EXPECT_THAT(log.text(), Not(HasSubstr("--tls-client-ca: a new one")));
}

TEST_F(TlsTest, FilesThatCannotBeUsedAreNamed) {
  const Certificate own = authority_.Issue("own"), other = authority_.Issue("other");
  ExpectError(ErrorCode::kInvalidArgument, "--tls-key", [&] {
    Start([&](ServerConfig& config) { Serve({own.certificate, other.key}, config); });
  });
  ExpectError(ErrorCode::kInvalidArgument, "--tls-cert", [&] {
    Start([&](ServerConfig& config) { Serve({own.key, own.key}, config); });
  });
  ExpectError(ErrorCode::kInvalidArgument, "client_key",
              [&] { Client({.tls = true, .client_certificate = own.certificate}); });
}

// OpenSSL would wait for the passphrase on the terminal.
TEST_F(TlsTest, AKeyWithAPassphraseIsRefused) {
  const Certificate own = authority_.Issue("own");
  const std::filesystem::path locked = folder_ / "locked.key";
  ASSERT_EQ(Shell("openssl pkcs8 -topk8 -in " + own.key.string() + " -out " + locked.string() +
                  " -passout pass:secret")
                .code,
            0);
  const std::string refusal = locked.string() + " is encrypted; a key without a passphrase";
  ExpectError(ErrorCode::kInvalidArgument, "--tls-key: " + refusal, [&] {
    Start([&](ServerConfig& config) { Serve({own.certificate, locked}, config); });
  });
  ExpectError(ErrorCode::kInvalidArgument, "client_key: " + refusal, [&] {
    Client({.tls = true, .client_certificate = own.certificate, .client_key = locked});
  });
}

TEST_F(TlsTest, AClientsFilesThatCannotBeUsedAreNamed) {
  const Certificate own = authority_.Issue("own"), other = authority_.Issue("other");
  const std::filesystem::path empty = folder_ / "empty.pem", text = folder_ / "text.pem",
                              fifo = folder_ / "fifo", damaged = folder_ / "damaged.pem";
  std::ofstream{empty};
  std::ofstream(text) << "no PEM at all\n";
  std::ofstream(damaged) << "-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const auto& [path, what] : std::vector<std::pair<std::filesystem::path, std::string>>{
           {empty, " is empty"},
           {text, " holds no certificate in PEM"},
           {damaged, " has a damaged certificate, number 1"},
           {fifo, " is a FIFO, no file"},
           {folder_.path(), " is a directory, no file"},
           {"/dev/zero", " is a device, no file"}}) {
    ExpectError(ErrorCode::kInvalidArgument, "ca_certificate: " + path.string() + what,
                [&] { Client({.tls = true, .ca_certificate = path}); });
    ExpectError(ErrorCode::kInvalidArgument, "client_certificate: " + path.string() + what,
                [&] { Client({.tls = true, .client_certificate = path, .client_key = own.key}); });
    ExpectError(ErrorCode::kInvalidArgument, "--tls-cert", [&] {
      Start([&](ServerConfig& config) { Serve({path, own.key}, config); });
    });
  }
  const auto client_with = [&](const std::filesystem::path& key) {
    Client({.tls = true, .client_certificate = own.certificate, .client_key = key});
  };
  ExpectError(ErrorCode::kInvalidArgument, "client_key: " + empty.string() + " is empty",
              [&] { client_with(empty); });
  ExpectError(ErrorCode::kInvalidArgument, "client_key: " + text.string() + " holds no private key",
              [&] { client_with(text); });
  ExpectError(
      ErrorCode::kInvalidArgument,
      "client_key: " + other.key.string() + " is not the key of " + own.certificate.string(),
      [&] { client_with(other.key); });
}

}  // namespace choreo::client::certificates_test
