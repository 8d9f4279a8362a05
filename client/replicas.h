#pragma once

#include <grpcpp/channel.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "choreo/v1/choreography.grpc.pb.h"
#include "client/choreo_client.h"
#include "client/retry_advice.h"
#include "grpc/health/v1/health.grpc.pb.h"

namespace choreo::client {

/// The available servers, and the one in use. Thread-safe.
class Replicas {
 public:
  struct Server {
    std::string address;
    std::shared_ptr<grpc::Channel> channel;
    std::shared_ptr<v1::Choreography::Stub> stub;
    std::shared_ptr<grpc::health::v1::Health::Stub> health;
  };

  /// Throws Error(kInvalidArgument) for unusable options.
  explicit Replicas(Options options);

  const Options& options() const { return options_; }
  /// Adds the token to a call. Throws Error(kNotFound) or Error(kInvalidArgument) whose field is
  /// "token_file".
  void Prepare(grpc::ClientContext* context) const;
  Server current() const;
  /// Switches from a failed server to the next, unless another caller already has. Returns false if
  /// there is no other.
  bool Leave(const Server& failed);
  /// Calls Options::retried.
  void TellOfRetry(const Server& failed, const grpc::Status& status) const;
  /// Waits for `time` before the next attempt, or until `stop`, which is polled, returns true.
  /// Connections are made meanwhile.
  void Wait(std::chrono::duration<double> time, const std::function<bool()>& stop) const;

 private:
  const Options options_;
  mutable std::mutex mutex_;
  std::vector<Server> servers_;
  size_t current_ = 0;
};

/// The deadline of a call over all its attempts, and the pauses between them.
class Patience {
 public:
  using Clock = std::chrono::system_clock;

  explicit Patience(const Options& options);

  std::optional<Clock::time_point> deadline() const { return deadline_; }
  /// Returns how long to wait after a failure of the server at `address` before a retry, on the
  /// same server or another one (`elsewhere`). Returns none if a retry is useless or no longer
  /// allowed, or if the server asks for a longer wait than is left of Options::retry_s. Throws what
  /// Options::before_retry throws.
  std::optional<std::chrono::duration<double>> Next(
      const grpc::Status& failed, const std::string& address, bool elsewhere,
      std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now());
  /// The status to report to the caller after Next returned none. A reachable server's refusal
  /// takes precedence over unreachable servers.
  const grpc::Status& Verdict() const { return verdict_; }
  /// The origin of Verdict: an address or, if no server was reached, all addresses tried since the
  /// last progress.
  std::string VerdictOf() const;
  /// Restarts the time for retries, because the call made progress.
  void Reset();

 private:
  double retry_s_;
  double first_backoff_s_;
  std::function<void()> before_retry_;
  std::optional<Clock::time_point> deadline_;
  size_t servers_;
  int failures_ = 0;     // since the last progress
  size_t refusals_ = 0;  // consecutive refusals by servers that would refuse again
  grpc::Status verdict_;
  std::string verdict_of_;
  std::vector<std::string>
      away_;  // addresses at which no server was reached, since the last progress
  std::chrono::steady_clock::time_point failing_since_;
  std::minstd_rand jitter_;
};

}  // namespace choreo::client
