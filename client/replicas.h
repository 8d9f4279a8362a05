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
#include "client/status.h"
#include "grpc/health/v1/health.grpc.pb.h"

namespace choreo::client {

/// The servers that may be asked, one at a time, and the one that is asked now. Thread-safe.
class Replicas {
 public:
  struct Server {
    std::string address;
    std::shared_ptr<grpc::Channel> channel;
    std::shared_ptr<v1::Choreography::Stub> stub;
    std::shared_ptr<grpc::health::v1::Health::Stub> health;
  };

  /// Throws Error(kInvalidArgument) for options that cannot be used.
  explicit Replicas(Options options);

  const Options& options() const { return options_; }
  /// What each call carries: the token. Throws Error(kNotFound) or Error(kInvalidArgument), field
  /// "token_file".
  void Prepare(grpc::ClientContext* context) const;
  Server current() const;
  /// This one failed: go on to the next, unless another caller went on already. False where there
  /// is no other.
  bool Leave(const Server& failed);
  /// Lets time pass before the next attempt, or until `stop`, which is asked every now and then;
  /// connections are made meanwhile.
  void Wait(std::chrono::duration<double> time, const std::function<bool()>& stop) const;

 private:
  const Options options_;
  mutable std::mutex mutex_;
  std::vector<Server> servers_;
  size_t current_ = 0;
};

/// When a call must be over, whatever its number of attempts; and how long to wait before the next
/// attempt.
class Patience {
 public:
  using Clock = std::chrono::system_clock;

  explicit Patience(const Options& options);

  std::optional<Clock::time_point> deadline() const { return deadline_; }
  /// How long to wait after `failed` before trying again, the same server or another one
  /// (`elsewhere`); none if trying again would not help, or is no longer allowed. Throws what
  /// Options::before_retry does.
  std::optional<std::chrono::duration<double>> Next(const grpc::Status& failed, bool elsewhere);
  /// After Next gave none: what to tell the caller. Why a server that is there would not serve says
  /// more than that another one is away.
  const grpc::Status& Verdict() const { return verdict_; }
  /// There was progress: count from the beginning.
  void Reset();

 private:
  double retry_s_;
  double first_backoff_s_;
  std::function<void()> before_retry_;
  std::optional<Clock::time_point> deadline_;
  size_t servers_;
  int failures_ = 0;     // since the last progress
  size_t refusals_ = 0;  // of servers that would refuse again, one after another
  grpc::Status verdict_;
  std::chrono::steady_clock::time_point failing_since_;
  std::minstd_rand jitter_;
};

}  // namespace choreo::client
