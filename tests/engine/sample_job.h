#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "model/engine/sample_queue.h"
#include "tests/support/fake_sampler.h"

namespace choreo {

/// What jobs did, in order.
class JobLog {
 public:
  void Add(const std::string& what) {
    const std::lock_guard lock(mutex_);
    all_.push_back(what);
  }
  std::vector<std::string> all() const {
    const std::lock_guard lock(mutex_);
    return all_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> all_;
};

/// A job of so many slices, which it logs by its name.
class LoggedJob : public SampleJob {
 public:
  LoggedJob(std::string name, int slices, double deadline, JobLog* log)
      : name_(std::move(name)), slices_(slices), deadline_(deadline), log_(log) {}

  /// Called in each slice, after it is logged; may throw.
  std::function<void()> in_slice;
  /// Called last.
  std::function<void()> at_end;

  bool Continue(Sampler& sampler) override {
    EXPECT_TRUE(sampler_ == nullptr || sampler_ == &sampler) << "another worker goes on with it";
    sampler_ = &sampler;
    if (log_ != nullptr) log_->Add(name_);
    if (in_slice) in_slice();
    return --slices_ > 0;
  }
  void OnDone(const Error* failure) noexcept override {
    if (at_end) at_end();
    done_.set_value(failure == nullptr ? std::nullopt : std::optional(*failure));
  }
  double Deadline() const override { return deadline_; }
  int frames() const override { return 10; }
  bool Cancelled() const override { return cancelled; }

  /// Waits until it is over; nothing if it went well.
  std::optional<Error> Result() { return done_.get_future().get(); }

  std::atomic<bool> cancelled = false;

 private:
  const std::string name_;
  int slices_;
  const double deadline_;
  JobLog* const log_;
  const Sampler* sampler_ = nullptr;
  std::promise<std::optional<Error>> done_;
};

}  // namespace choreo
