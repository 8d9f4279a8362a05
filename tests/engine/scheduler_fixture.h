#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "model/engine/scheduler.h"
#include "tests/engine/fake_job.h"
#include "tests/engine/gated_engine.h"

namespace choreo {

inline constexpr auto kLong = std::chrono::minutes(1);

inline ErrorCode CodeOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorCode::kInternal;
}

/// A scheduler with one engine whose steps a gate lets through.
class SchedulerTest : public ::testing::Test {
 protected:
  // Nobody loses a slot for sleeping, unless `max_sleep` says so.
  void Start(int slots, Scheduler::Options options = {}, uint64_t poison = 0,
             std::chrono::milliseconds max_sleep = kLong) {
    std::vector<std::unique_ptr<StepEngine>> engines;
    engines.push_back(std::make_unique<GatedEngine>(slots, &gate_, poison));
    options.max_admissions = admissions_;
    options.max_sleep = max_sleep;
    scheduler_ = std::make_unique<Scheduler>(std::move(engines), options);
  }
  // Its seed names it in gate_.steps().
  std::shared_ptr<FakeJob> Job(uint64_t seed, int frames) {
    return std::make_shared<FakeJob>(MakeSpec(scheduler_->model(), frames, seed));
  }
  std::shared_ptr<FakeJob> SubmitJob(uint64_t seed, int frames) {
    auto job = Job(seed, frames);
    scheduler_->Submit(job);
    return job;
  }
  // A job that holds its slot and sleeps.
  std::shared_ptr<FakeJob> SubmitSleeper(uint64_t seed, int frames = 10) {
    auto job = Job(seed, frames);
    job->allowed_frames = 0;
    scheduler_->Submit(job);
    EXPECT_TRUE(job->WaitRefusals(1));
    return job;
  }
  // Closes the gate and lets a job of one frame, seed 99, stand there: what is submitted until the
  // gate opens meets in the next step.
  std::shared_ptr<FakeJob> HoldWorker() {
    gate_.Close();
    auto job = SubmitJob(99, 1);
    EXPECT_TRUE(gate_.WaitSteps(1));
    return job;
  }

  int admissions_ = 64;  // all at once, which is easier to follow
  Gate gate_;
  std::unique_ptr<Scheduler> scheduler_;  // goes before the gate
};

}  // namespace choreo
