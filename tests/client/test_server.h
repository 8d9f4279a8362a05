#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/server.h"
#include "tests/support/fake_sampler.h"

namespace choreo {

/// A FakeSampler of any fingerprint.
class NamedSampler final : public FakeSampler {
 public:
  explicit NamedSampler(std::string fingerprint) { model_.fingerprint = std::move(fingerprint); }
};

/// A FakeSampler that is lost after so many frames.
class BreakingSampler final : public FakeSampler {
 public:
  explicit BreakingSampler(int frames) : left_(frames) {}
  void OnFrame(const TransitionSpec& /*spec*/, Plan* /*plan*/) override {
    if (left_-- == 0) throw Error(ErrorCode::kInternal, "", "the device is gone");
  }

 private:
  int left_;
};

/// A real server in this process, on a free port.
class TestServer {
 public:
  explicit TestServer(const std::string& fingerprint = "fake-1",
                      const std::string& listen = "127.0.0.1:0")
      : TestServer(std::make_unique<NamedSampler>(fingerprint), listen) {}
  explicit TestServer(std::unique_ptr<Sampler> sampler, const std::string& listen = "127.0.0.1:0",
                      const std::function<void(ServerConfig&)>& change = {}) {
    ServerConfig config;
    config.listen = listen;
    if (change) change(config);
    std::vector<Server::Samplers> models(1);
    models[0].push_back(std::move(sampler));
    server_ = std::make_unique<Server>(config, std::move(models));
    address_ = "127.0.0.1:" + std::to_string(server_->port());
  }

  const std::string& address() const { return address_; }
  int port() const { return server_->port(); }
  int calls() const { return server_->calls(); }
  int transitions() const { return server_->transitions(); }
  void Drain(double seconds) { server_->Drain(seconds); }
  /// At once, with all its calls.
  void Die() { Drain(0); }

 private:
  std::unique_ptr<Server> server_;
  std::string address_;
};

}  // namespace choreo
