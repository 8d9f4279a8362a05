#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "model/engine/scheduler.h"

namespace choreo {

/// A resting dancer's transition to a place one metre ahead.
inline TransitionSpec MakeSpec(const ModelInfo& model, int frames, uint64_t seed = 1) {
  TransitionSpec spec;
  spec.frames = frames;
  Pose rest;
  rest.root_position = {0, model.skeleton.pelvis_height, 0};
  rest.rotations = Eigen::Matrix3Xd::Zero(3, model.skeleton.joints());
  spec.history.assign(static_cast<size_t>(model.history_frames), rest);
  spec.target = Target{rest, {}};
  spec.target->pose.root_position.z() += 1;
  spec.seed = seed;
  spec.first_frame = 100;
  spec.temperature = 1;
  return spec;
}

/// A job that is told what to do by its test and remembers what was done to it.
class FakeJob : public StepJob {
 public:
  explicit FakeJob(TransitionSpec spec) : spec_(std::move(spec)) {}

  // How it behaves. Set before Submit, but for these two atomics.
  std::atomic<int> allowed_frames = std::numeric_limits<int>::max();  ///< then it sleeps
  std::atomic<bool> cancelled = false;
  double deadline = 0;
  std::function<void()> on_frame;               ///< called first in OnFrame; may throw
  std::function<void(const Error*)> when_done;  ///< called last in OnDone
  std::function<void()> before_input;           ///< called first in NextInput; may throw
  std::function<void()> before_ready;           ///< called first in Ready, on a worker's thread

  const TransitionSpec& spec() const override { return spec_; }
  bool NextInput(StepInput* input) override {
    if (before_input) before_input();
    if (static_cast<int>(frames_.size()) >= allowed_frames) {
      std::lock_guard lock(mutex_);
      ++refusals_;
      changed_.notify_all();
      return false;
    }
    input->previous = frames_.empty() ? nullptr : &frames_.back().pose;
    return true;
  }
  bool Ready() const override {
    if (before_ready) before_ready();
    return count_ < allowed_frames;
  }
  void OnRestart() override {
    ++restarts_;
    frames_.clear();
    count_ = 0;
  }
  bool OnFrame(const StepOutput& raw) override {
    if (on_frame) on_frame();
    frames_.push_back(raw);
    ++count_;
    return static_cast<int>(frames_.size()) < spec_.frames;
  }
  void OnDone(const Error* failure) noexcept override {
    if (when_done) when_done(failure);
    std::lock_guard lock(mutex_);
    ++done_;
    if (failure != nullptr) failure_ = *failure;
    changed_.notify_all();
  }
  double NextDeadline() const override { return deadline; }
  bool Cancelled() const override { return cancelled; }

  /// Waits for OnDone; false after a minute.
  bool WaitDone() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::minutes(1), [this] { return done_ > 0; });
  }
  /// Waits until NextInput has said no this often.
  bool WaitRefusals(int count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::minutes(1), [&] { return refusals_ >= count; });
  }
  /// Read these after WaitDone.
  const std::vector<StepOutput>& frames() const { return frames_; }
  int times_done() const { return done_; }
  int restarts() const { return restarts_; }
  std::optional<ErrorCode> failure() const {
    return failure_ ? std::optional(failure_->code()) : std::nullopt;
  }

 private:
  TransitionSpec spec_;
  std::vector<StepOutput> frames_;
  std::atomic<int> count_ = 0;  // of frames_
  std::atomic<int> restarts_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  int refusals_ = 0;
  int done_ = 0;
  std::optional<Error> failure_;
};

}  // namespace choreo
