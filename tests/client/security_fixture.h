#pragma once

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <memory>
#include <sstream>
#include <string>

#include "client/choreo_client.h"
#include "tests/client/test_server.h"
#include "tests/support/certificates.h"
#include "tests/support/eventually.h"
#include "tests/support/temporary_folder.h"

namespace choreo::client {

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

/// Which clients are admitted, and who can read the traffic.
class SecurityTest : public testing::Test {
 protected:
  static std::unique_ptr<TestServer> Start(const std::function<void(ServerConfig&)>& change) {
    return std::make_unique<TestServer>(std::make_unique<FakeSampler>(), "127.0.0.1:0", change);
  }
  static bool Serves(const Options& options) {
    try {
      return Client(options).GetServerInfo().workers > 0;
    } catch (const Error&) {
      return false;
    }
  }
  static void ExpectEventually(const std::function<bool()>& condition, const std::string& what) {
    ASSERT_TRUE(Eventually(condition)) << "never came about: " << what;
  }

  TemporaryFolder folder_;
};

class TlsTest : public SecurityTest {
 protected:
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

  const Authority authority_{folder_.path(), "authority"};
  const Authority stranger_{folder_.path(), "stranger"};
};

}  // namespace choreo::client
