#include <gmock/gmock.h>

#include "server/connections/handshakes.h"
#include "tests/client/run_choreo.h"
#include "tests/client/security_fixture.h"
#include "tests/support/expect_error.h"

/// Who connects over TLS, and what the log says of the others.
namespace choreo::client::tls_test {

using testing::HasSubstr;
using testing::Not;

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
  // Perhaps together with a client that left.
  ExpectEventually([&] { return log.text().find(" timed_out") != std::string::npos; },
                   "the last is logged");
  EXPECT_THAT(log.text(), testing::HasSubstr("; likely of"));
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

TEST_F(TlsTest, TlsOptionsNeedTls) {
  ExpectError(ErrorCode::kInvalidArgument, "ca_certificate",
              [&] { Client({.ca_certificate = folder_ / "ca.pem"}); });
}

}  // namespace choreo::client::tls_test
