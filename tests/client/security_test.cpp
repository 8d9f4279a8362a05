#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <ctime>
#include <fstream>
#include <iostream>
#include <sstream>

#include "client/choreo_client.h"
#include "server/connections/handshakes.h"
#include "server/settings/certificate_files.h"
#include "server/settings/tokens.h"
#include "tests/client/run_choreo.h"
#include "tests/client/test_server.h"
#include "tests/support/certificates.h"
#include "tests/support/eventually.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

/// Which clients are admitted, and who can read the traffic.
namespace choreo::client::security_test {

using testing::HasSubstr;
using testing::Not;

void ExpectEventually(const std::function<bool()>& condition, const std::string& what) {
  ASSERT_TRUE(Eventually(condition)) << "never came about: " << what;
}

/// All that is logged while it lives.
class LogCapture {
 public:
  LogCapture() {
    auto logger = std::make_shared<spdlog::logger>(
        "log", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_));
    logger->set_level(spdlog::level::trace);
    spdlog::set_default_logger(logger);
  }
  ~LogCapture() { spdlog::set_default_logger(before_); }
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  const std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
};

bool Serves(const Options& options) {
  try {
    return Client(options).GetServerInfo().workers > 0;
  } catch (const Error&) {
    return false;
  }
}

class SecurityTest : public testing::Test {
 protected:
  std::unique_ptr<TestServer> Start(const std::function<void(ServerConfig&)>& change) {
    return std::make_unique<TestServer>(std::make_unique<FakeSampler>(), "127.0.0.1:0", change);
  }
  static void Serve(const Certificate& own, ServerConfig& config) {
    config.tls_certificate = own.certificate;
    config.tls_key = own.key;
  }
  static Options Trusting(const TestServer& server, const Authority& authority) {
    return {.addresses = {server.address()},
            .tls = true,
            .ca_certificate = authority.certificate(),
            .retry_s = 0};
  }

  TemporaryFolder folder_;
  const Authority authority_{folder_.path(), "authority"};
  const Authority stranger_{folder_.path(), "stranger"};
};

using TlsTest = SecurityTest;

TEST_F(TlsTest, OnlyTrustingClientsConnect) {
  const Certificate own = authority_.Issue("own");
  const auto server = Start([&](ServerConfig& config) { Serve(own, config); });
  const Options trusting = Trusting(*server, authority_);
  const DanceResult danced = Client(trusting).Dance({.seed = 1, .frames = 40}, {}, {});
  EXPECT_EQ(danced.motion.frames.size(), 40U);
  ExpectError(ErrorCode::kUnavailable, "not from the trusted authority (--ca)",
              [&] { Client(Trusting(*server, stranger_)).IsServing(); });
  ExpectError(ErrorCode::kUnavailable, "; it may need TLS, which is off",
              [&] { Client({.addresses = {server->address()}, .retry_s = 0}).GetServerInfo(); });
  Options of_another_name = trusting;
  of_another_name.server_name = "example.test";
  EXPECT_FALSE(Serves(of_another_name));
  EXPECT_TRUE(Serves(trusting));
  const Outcome health = Choreo("health --server " + server->address() + " --tls --ca " +
                                authority_.certificate().string());
  EXPECT_EQ(health.code, 0) << health.said;
}

// A restart would not renew the certificate, so liveness probes ignore it.
TEST_F(TlsTest, AServerWithAnExpiredCertificateIsAlive) {
  const Certificate late = authority_.IssueExpired("late"), own = authority_.Issue("own");
  const auto server = Start([&](ServerConfig& config) {
    Serve(late, config);
    config.tls_client_ca = authority_.certificate();
  });
  const std::string health = "health --server " + server->address() + " --tls --client-cert " +
                             own.certificate.string() + " --client-key " + own.key.string();
  const Outcome trusting = Choreo(health + " --ca " + authority_.certificate().string());
  EXPECT_EQ(trusting.code, 1) << trusting.said;
  // Another authority's file or none is accepted, and no token is sent.
  for (const char* ca : {"", " --ca /missing.pem --token-file /missing"}) {
    const Outcome alive = Choreo(health + ca + " --any-certificate");
    EXPECT_EQ(alive.code, 0) << alive.said;
  }
  // The client still needs its own certificate. Probes take it from the environment.
  const std::string probe = "health --server " + server->address() + " --tls --any-certificate";
  EXPECT_EQ(Choreo(probe).code, 1);
  ::setenv("CHOREO_CLIENT_CERT", own.certificate.c_str(), 1);
  ::setenv("CHOREO_CLIENT_KEY", own.key.c_str(), 1);
  const Outcome identified = Choreo(probe);
  ::unsetenv("CHOREO_CLIENT_CERT");
  ::unsetenv("CHOREO_CLIENT_KEY");
  EXPECT_EQ(identified.code, 0) << identified.said;
  ExpectError(ErrorCode::kInvalidArgument, "token_file: a token is not sent to", [&] {
    const Client client({.addresses = {server->address()},
                         .tls = true,
                         .any_certificate = true,
                         .token_file = folder_ / "token"});
  });
}

TEST_F(TlsTest, OldVersionsAreRefused) {
  const Certificate own = authority_.Issue("own");
  const auto server = Start([&](ServerConfig& config) { Serve(own, config); });
  const auto shake_hands = [&](const std::string& version) {
    return Shell("openssl s_client -connect " + server->address() + " -alpn h2 -" + version +
                 " -cipher 'ALL:@SECLEVEL=0' </dev/null")
        .said;
  };
  EXPECT_THAT(shake_hands("tls1_2"), HasSubstr("BEGIN CERTIFICATE"));
  EXPECT_THAT(shake_hands("tls1_1"), Not(HasSubstr("BEGIN CERTIFICATE")));
  EXPECT_THAT(shake_hands("tls1"), Not(HasSubstr("BEGIN CERTIFICATE")));
}

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

TEST_F(TlsTest, ClientsShowARequiredCertificate) {
  const Certificate own = authority_.Issue("own");
  const auto server = Start([&](ServerConfig& config) {
    Serve(own, config);
    config.tls_client_ca = authority_.certificate();
  });
  const auto serving = [&](const Certificate& shown) {
    Options options = Trusting(*server, authority_);
    options.client_certificate = shown.certificate;
    options.client_key = shown.key;
    return Client(options).IsServing();
  };
  const auto refused = [&](const Certificate& shown, const std::string& hint) {
    ExpectError(ErrorCode::kUnavailable, hint, [&] { serving(shown); });
  };
  refused({}, "; it may need a client certificate");
  refused(stranger_.Issue("intruder"), "; it may refuse this client certificate");
  EXPECT_TRUE(serving(authority_.Issue("guest")));
}

// gRPC names no peer, so the server can only name the likely one.
TEST_F(TlsTest, FailedHandshakesAreCountedAndTheirPeersNamed) {
  const LogCapture log;
  const Certificate own = authority_.Issue("own"), guest = authority_.Issue("guest"),
                    intruder = stranger_.Issue("intruder");
  const auto server = Start([&](ServerConfig& config) {
    Serve(own, config);
    config.tls_client_ca = authority_.certificate();
  });
  // Clients are other processes, because failures on their side would be counted, too.
  constexpr size_t kLeft = 6;
  const auto attempt = [&](const std::string& command, size_t fault) {
    SCOPED_TRACE(kHandshakeFaults[fault]);
    const HandshakeFaults before = CountedHandshakeFaults();
    EXPECT_NE(Shell(command).code, 0);
    ExpectEventually([&] { return CountedHandshakeFaults()[fault] > before[fault]; },
                     "it is counted");
    for (size_t other = 0; other < before.size(); ++other) {
      // A client for which a busy machine is too slow leaves, too.
      if (other == fault || other == kLeft) continue;
      EXPECT_EQ(CountedHandshakeFaults()[other], before[other]) << kHandshakeFaults[other];
    }
  };
  const std::string health = "'" CHOREO_PROGRAM "' health --server " + server->address();
  const std::string trusting = health + " --tls --ca " + authority_.certificate().string();
  attempt(trusting, 0);
  attempt(trusting + " --client-cert " + intruder.certificate.string() + " --client-key " +
              intruder.key.string(),
          1);
  // gRPC's clients do not say this to the server; others do.
  const std::string own_files =
      " --client-cert " + guest.certificate.string() + " --client-key " + guest.key.string();
  attempt(health + " --tls --ca " + stranger_.certificate().string() + own_files, kLeft);
  attempt("openssl s_client -connect " + server->address() +
              " -alpn h2 -verify_return_error -CAfile " + stranger_.certificate().string() +
              " -cert " + guest.certificate.string() + " -key " + guest.key.string() +
              " </dev/null",
          2);
  attempt(health, 3);
  // The client sends nothing until the server closes the connection.
  std::string silent = server->address();
  silent.replace(silent.rfind(':'), 1, "/");
  attempt("bash -c 'cat < /dev/tcp/" + silent + "; exit 1'", 5);
  ExpectEventually([&] { return log.text().find("timed_out; likely of") != std::string::npos; },
                   "the last is logged");
  EXPECT_THAT(log.text(), testing::ContainsRegex("\\[warning\\] TLS handshakes failed: [0-9]+ "
                                                 "no_client_certificate.*; likely of "
                                                 "ipv4:127.0.0.1:[0-9]+"));
}

// gRPC's own form is "ipv6:%5B::1%5D:50051".
TEST_F(SecurityTest, AddressesInTheLogHaveTheirBrackets) {
  const LogCapture log;
  const TestServer server(std::make_unique<FakeSampler>(), "[::1]:0");
  Client({.addresses = {"[::1]:" + std::to_string(server.port())}}).GetServerInfo();
  ExpectEventually(
      [&] { return log.text().find("GetServerInfo ipv6:[::1]:") != std::string::npos; },
      "the call has its line");
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

class TokensTest : public SecurityTest {
 protected:
  void Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  // The token's line in the server's file.
  std::string LineOf(const std::string& token, const std::string& holder) {
    Write("plain", token);
    const std::string hash = Shell("sha256sum " + (folder_ / "plain").string()).said.substr(0, 64);
    return hash + "  " + holder + '\n';
  }
  Options With(const TestServer& server, const std::string& token) {
    Options options{.addresses = {server.address()}, .retry_s = 0};
    if (token.empty()) return options;
    Write("token", token + '\n');
    options.token_file = folder_ / "token";
    return options;
  }
};

TEST_F(TokensTest, HoldersAreServedUntilRemoval) {
  const std::filesystem::path file = folder_ / "tokens";
  Write("tokens", "# who may call\n\n" + LineOf("correct-horse", "alice") + LineOf("b", "bob"));
  const auto server = Start([&](ServerConfig& config) { config.tokens = file; });
  EXPECT_EQ(Client(With(*server, "correct-horse")).Dance({.frames = 20}, {}, {}).report.frames, 20);
  EXPECT_TRUE(Serves(With(*server, "b")));

  for (const std::string wrong : {"", "correct-hors", "correct-horsf", "alice"}) {
    const Client client(With(*server, wrong));
    for (const std::function<void()>& call : std::vector<std::function<void()>>{
             [&] { client.GetServerInfo(); },
             [&] { client.Dance({.frames = 20}, {}, {}); },
             [&] { client.GenerateTransition({.frames = 5}); },
         }) {
      ExpectError(ErrorCode::kFailedPrecondition, "authorization: Bearer TOKEN", call);
    }
  }
  EXPECT_TRUE(Client(With(*server, "")).IsServing());  // probes have none

  Write("tokens", LineOf("b", "bob"));
  ExpectEventually([&] { return !Serves(With(*server, "correct-horse")); }, "alice is struck out");
  EXPECT_TRUE(Serves(With(*server, "b")));
}

// Removed holders stay refused, whatever happens to the file.
TEST_F(TokensTest, ADanceGoesOnWithARenewedToken) {
  Write("tokens", LineOf("old", "alice") + LineOf("new", "alice"));
  const auto server = Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; });
  Options options = With(*server, "old");
  options.retry_s = 20;
  const Client client(options);
  const auto dance = client.StartDance({.seed = 4, .frames = 250});
  dance->GenerateUntil(120);
  size_t frames = 0;
  int resumed = 0;
  bool renewed = false;
  while (const std::optional<Message> message = dance->Next()) {
    if (const auto* block = std::get_if<FrameBlock>(&*message)) frames += block->poses.size();
    if (std::holds_alternative<Continuation>(*message) && !std::exchange(renewed, true)) {
      Write("token", "new\n");
      Write("tokens", LineOf("new", "alice"));
    }
    if (!std::holds_alternative<Resumed>(*message)) continue;
    ++resumed;
    dance->CompleteKeys();
  }
  EXPECT_EQ(frames, 250U);
  EXPECT_EQ(resumed, 1);
}

TEST_F(TokensTest, BrokenFileAdmitsNobody) {
  const std::filesystem::path file = folder_ / "tokens";
  const std::string alice = LineOf("a", "alice"), bob = LineOf("b", "bob");
  Write("tokens", alice + bob);
  const auto server = Start([&](ServerConfig& config) { config.tokens = file; });
  const auto becomes = [&](const std::string& token, bool serves, const std::string& what) {
    ExpectEventually([&] { return Serves(With(*server, token)) == serves; }, what);
  };
  becomes("a", true, "both are known");
  Write("tokens", "0123 carol\n" + bob);  // good lines count beside a bad one
  becomes("a", false, "alice is struck out");
  EXPECT_TRUE(Serves(With(*server, "b")));
  std::filesystem::remove(file);
  becomes("b", false, "without a file nobody is known");
  Write("tokens", alice);
  becomes("a", true, "it is there again");
  std::filesystem::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  becomes("a", false, "a FIFO holds nobody up, and lets nobody in");
  std::filesystem::remove(file);
  Write("tokens", bob);
  becomes("b", true, "after which it goes on");
  Write("tokens", std::string(2 << 20, '#'));
  becomes("b", false, "what is too long is not read");
}

// A writer may have failed, or the disk was full.
TEST_F(TokensTest, AnEmptiedFileKeepsTheFormerTokens) {
  const LogCapture log;
  const std::string alice = LineOf("a", "alice");
  Write("tokens", alice);
  Tokens tokens(folder_ / "tokens");
  std::string holder;
  for (const char* empty : {"", "\n", "# nobody\n"}) {
    Write("tokens", empty);
    EXPECT_EQ(tokens.Refresh(), std::nullopt) << "it may just be written";
    EXPECT_EQ(tokens.Refresh(), false) << empty;
    EXPECT_EQ(tokens.Refresh(), std::nullopt) << "this was told";
    EXPECT_TRUE(tokens.FindHolder("Bearer a", &holder).ok()) << empty;
    Write("tokens", alice);
    EXPECT_EQ(tokens.Refresh(), true);
  }
  EXPECT_THAT(log.text(), HasSubstr("[error] --tokens: " + (folder_ / "tokens").string() +
                                    " holds no token, no line \"SHA256 NAME\"; the 1 tokens"));
}

// A file that cannot be read may come back in a moment, so it revokes no dance.
TEST_F(TokensTest, AnUnreadableFileEndsNoDance) {
  Write("tokens", LineOf("a", "alice"));
  Tokens tokens(folder_ / "tokens");
  std::string holder;
  Tokens::Hash hash;
  ASSERT_TRUE(tokens.FindHolder("Bearer a", &holder, &hash).ok());
  EXPECT_FALSE(tokens.IsRevoked(hash));
  std::filesystem::remove(folder_ / "tokens");
  EXPECT_EQ(tokens.Refresh(), false);
  EXPECT_FALSE(tokens.FindHolder("Bearer a", &holder).ok());
  EXPECT_FALSE(tokens.IsRevoked(hash));
  Write("tokens", LineOf("b", "bob"));
  EXPECT_EQ(tokens.Refresh(), true);
  EXPECT_TRUE(tokens.IsRevoked(hash));
}

// This may be another file, or one whose writer failed halfway.
TEST_F(TokensTest, AFileOfBadLinesKeepsTheFormerTokens) {
  const LogCapture log;
  Write("tokens", LineOf("a", "alice"));
  Tokens tokens(folder_ / "tokens");
  std::string holder;
  const auto knows_alice = [&] { return tokens.FindHolder("Bearer a", &holder).ok(); };
  Write("tokens", "# who may call\njunk line here\n");
  EXPECT_EQ(tokens.Refresh(), false);
  EXPECT_EQ(tokens.Refresh(), std::nullopt) << "this was told";
  EXPECT_TRUE(knows_alice());
  EXPECT_THAT(log.text(), HasSubstr("[error] --tokens: " + (folder_ / "tokens").string() +
                                    " line 2: not \"SHA256 NAME\""));
  EXPECT_THAT(log.text(), HasSubstr("the 1 tokens known before stay valid"));
  // Removed tokens do not return.
  std::filesystem::remove(folder_ / "tokens");
  EXPECT_EQ(tokens.Refresh(), false);
  Write("tokens", "junk line here\n");
  EXPECT_EQ(tokens.Refresh(), false);
  EXPECT_FALSE(knows_alice());
}

// All callers have one address, like those behind one back end.
TEST_F(TokensTest, EachHolderHasItsOwnPlaces) {
  Write("tokens", LineOf("a", "alice") + LineOf("b", "bob"));
  const auto server = Start([&](ServerConfig& config) {
    config.tokens = folder_ / "tokens";
    config.max_streams = 3;
    config.max_streams_of_peer = 1;
  });
  const Client alice(With(*server, "a"));
  const auto dance = alice.StartDance({.frames = 30});
  ASSERT_TRUE(dance->Next());
  ExpectError(ErrorCode::kResourceExhausted,
              server->address() +
                  ": holder \"alice\" has 1 calls in progress, of at most 1 for one caller; it "
                  "asks to try again in ",
              [&] { alice.GenerateTransition({.frames = 5}); });
  Write("bobs", "b\n");
  const Client bob(
      {.addresses = {server->address()}, .token_file = folder_ / "bobs", .retry_s = 0});
  EXPECT_EQ(bob.GenerateTransition({.frames = 5}).candidates.size(), 1U);
}

TEST_F(TokensTest, TheSchemeIsTheSameInEitherCase) {
  Write("tokens", LineOf("a", "alice"));
  const Tokens tokens(folder_ / "tokens");
  std::string holder;
  for (const char* good : {"Bearer a", "bearer a", "BEARER a", "bearer   a"}) {
    EXPECT_TRUE(tokens.FindHolder(good, &holder).ok()) << good;
  }
  for (const char* bad :
       {"", "a", "Bearer", "Bearera", "Bearer ", "Basic a", "Bearer\ta", " a", "Bearer a "}) {
    EXPECT_FALSE(tokens.FindHolder(bad, &holder).ok()) << bad;
  }
}

TEST_F(TokensTest, NoneIsLogged) {
  const LogCapture log;
  Write("tokens", LineOf("correct-horse", "alice"));
  auto server = Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; });
  EXPECT_TRUE(Serves(With(*server, "correct-horse")));
  EXPECT_FALSE(Serves(With(*server, "wrong-horse")));
  Write("tokens", "correct-horse alice\n");
  ExpectEventually([&] { return log.text().find("tokens line 1") != std::string::npos; },
                   "the bad line is told");
  server.reset();
  EXPECT_THAT(log.text(), HasSubstr("(alice)"));
  EXPECT_THAT(log.text(), HasSubstr("tokens line 1"));
  EXPECT_THAT(log.text(), Not(HasSubstr("horse")));
}

// A token made by `openssl rand -hex 32` looks like a hash.
TEST_F(TokensTest, ARawTokenInTheFileIsTold) {
  const LogCapture log;
  const std::string raw(64, '7');
  Write("tokens", raw + " alice\n");
  const Tokens tokens(folder_ / "tokens");
  std::string holder;
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(tokens.FindHolder("Bearer " + raw, &holder).ok());
  EXPECT_THAT(log.text(), HasSubstr("the line of alice has the token itself"));
  EXPECT_EQ(log.text().find("alice"), log.text().rfind("alice")) << "told once";
  EXPECT_THAT(log.text(), Not(HasSubstr(raw)));
}

TEST_F(TokensTest, AreSentOnlyOverTlsOrLocally) {
  Write("token", "correct-horse");
  ExpectError(ErrorCode::kInvalidArgument, "only over TLS", [&] {
    Client({.addresses = {"127.0.0.1:1", "example.test:1"}, .token_file = folder_ / "token"});
  });
  for (const std::string name : {"127.example.test:1", "localhost.example.test:1"}) {
    ExpectError(ErrorCode::kInvalidArgument, "only over TLS",
                [&] { Client({.addresses = {name}, .token_file = folder_ / "token"}); });
  }
}

TEST_F(TokensTest, EmptyTokensAreRefused) {
  Write("tokens", LineOf("", "nobody"));
  std::string holder;
  const Tokens tokens(folder_ / "tokens");
  EXPECT_EQ(tokens.FindHolder("Bearer ", &holder).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(holder, "");
}

TEST_F(TokensTest, TlsOptionsNeedTls) {
  ExpectError(ErrorCode::kInvalidArgument, "ca_certificate",
              [&] { Client({.ca_certificate = folder_ / "ca.pem"}); });
}

TEST_F(TokensTest, FilesThatCannotBeUsedAreNamed) {
  Write("tokens", LineOf("a", "alice") + "0123 bob\n");
  ExpectError(ErrorCode::kInvalidArgument, "tokens line 2",
              [&] { Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; }); });
  Write("tokens", "junk line here\n");
  ExpectError(ErrorCode::kInvalidArgument, "tokens line 1",
              [&] { Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; }); });
  Write("tokens", std::string(2 << 20, '#'));
  ExpectError(ErrorCode::kInvalidArgument, "2097152 bytes, of at most 1048576",
              [&] { Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; }); });
  for (const char* empty : {"", "# nobody yet\n"}) {
    Write("tokens", empty);
    ExpectError(ErrorCode::kInvalidArgument, "tokens holds no token",
                [&] { Start([&](ServerConfig& config) { config.tokens = folder_ / "tokens"; }); });
  }
  for (const char* none : {"/tmp", "/dev/zero"}) {
    ExpectError(ErrorCode::kInvalidArgument, std::string("--tokens: ") + none,
                [&] { Start([&](ServerConfig& config) { config.tokens = none; }); });
  }
  const auto server = Start({});
  Options options = With(*server, "two words");
  ExpectError(ErrorCode::kInvalidArgument, "visible ASCII",
              [&] { Client(options).GetServerInfo(); });
  options.token_file = "/absent";
  ExpectError(ErrorCode::kInvalidArgument, "/absent", [&] { Client(options).GetServerInfo(); });
}

}  // namespace choreo::client::security_test
