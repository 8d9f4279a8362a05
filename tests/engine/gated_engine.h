#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

#include "tests/support/fake_engine.h"

namespace choreo {

/// What a test shares with an engine that the scheduler owns: it lets steps pass one by one and
/// sees who was in them.
class Gate {
 public:
  /// Steps pass freely until Close.
  void Close() {
    std::lock_guard lock(mutex_);
    permits_ = 0;
    closed_ = true;
  }
  /// Lets all steps pass from now on.
  void Open() {
    std::lock_guard lock(mutex_);
    closed_ = false;
    changed_.notify_all();
  }
  /// Lets one step pass and waits until the worker stands before the next one.
  bool PassOne() {
    std::unique_lock lock(mutex_);
    ++permits_;
    const size_t arrived = steps_.size();
    changed_.notify_all();
    return Wait(lock, [&] { return steps_.size() > arrived; });
  }
  /// Waits until this many steps have begun (the last of them may stand at the gate).
  bool WaitSteps(size_t count) {
    std::unique_lock lock(mutex_);
    return Wait(lock, [&] { return steps_.size() >= count; });
  }
  /// A step stands at the gate until it may pass.
  void Enter(std::vector<uint64_t> seeds) {
    std::unique_lock lock(mutex_);
    steps_.push_back(std::move(seeds));
    changed_.notify_all();
    Wait(lock, [this] { return !closed_ || permits_ > 0; });
    if (closed_) --permits_;
  }
  /// The seeds of the slots of each step begun, in the order of the batch.
  std::vector<std::vector<uint64_t>> steps() const {
    std::lock_guard lock(mutex_);
    return steps_;
  }

 private:
  template <typename Condition>
  bool Wait(std::unique_lock<std::mutex>& lock, Condition condition) {
    return changed_.wait_for(lock, std::chrono::minutes(1), condition);
  }
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool closed_ = false;
  int permits_ = 0;
  std::vector<std::vector<uint64_t>> steps_;
};

/// FakeEngine behind a gate. Throws in a step that holds a job of `poison` seed.
class GatedEngine : public FakeEngine {
 public:
  GatedEngine(int slots, Gate* gate, uint64_t poison = 0, std::string device = "fake:0")
      : FakeEngine(slots, std::move(device)),
        gate_(gate),
        poison_(poison),
        seeds_(static_cast<size_t>(slots)) {}

  int BeginAdmission(const TransitionSpec& spec) override {
    const int slot = FakeEngine::BeginAdmission(spec);
    seeds_[static_cast<size_t>(slot)] = spec.seed;
    return slot;
  }
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override {
    std::vector<uint64_t> seeds;
    for (const StepInput& input : in) seeds.push_back(seeds_[static_cast<size_t>(input.slot)]);
    gate_->Enter(seeds);
    if (poison_ != 0 && std::find(seeds.begin(), seeds.end(), poison_) != seeds.end()) {
      throw std::runtime_error("poisoned step");
    }
    FakeEngine::Step(in, out);
  }

 protected:
  Gate* gate() const { return gate_; }
  uint64_t SeedOf(int slot) const { return seeds_[static_cast<size_t>(slot)]; }

 private:
  Gate* gate_;
  uint64_t poison_;
  std::vector<uint64_t> seeds_;
};

}  // namespace choreo
