#include <gmock/gmock.h>

#include "tests/engine/scheduler_fixture.h"

namespace choreo {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::ElementsAre;

// Who sleeps in the only slot makes room, and is danced anew, frame by frame as alone.
TEST_F(SchedulerTest, WhoSleepsHoldsUpNobodyAndLosesNoBit) {
  Start(1, {}, 0, milliseconds(1));
  auto alone = SubmitJob(1, 10);
  ASSERT_TRUE(alone->WaitDone());

  auto sleeper = Job(1, 10);
  sleeper->allowed_frames = 4;
  scheduler_->Submit(sleeper);
  ASSERT_TRUE(sleeper->WaitRefusals(1));
  for (uint64_t seed = 2; seed < 5; ++seed) {
    auto other = SubmitJob(seed, 3);
    ASSERT_TRUE(other->WaitDone());
    EXPECT_EQ(other->failure(), std::nullopt);
  }
  EXPECT_EQ(scheduler_->stats().parked, 1);
  scheduler_->Wake(sleeper.get());  // a wake too many: it is not ready
  sleeper->allowed_frames = 10;
  scheduler_->Wake(sleeper.get());
  ASSERT_TRUE(sleeper->WaitDone());
  EXPECT_EQ(sleeper->failure(), std::nullopt);
  EXPECT_EQ(sleeper->restarts(), 1);
  ASSERT_EQ(sleeper->frames().size(), 10U);
  for (size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(sleeper->frames()[i].pose.rotations, alone->frames()[i].pose.rotations);
    EXPECT_EQ(sleeper->frames()[i].pose.root_position, alone->frames()[i].pose.root_position);
  }
}

TEST_F(SchedulerTest, WhoSleepsKeepsTheSlotWhileNobodyWaits) {
  Start(2, {}, 0, milliseconds(0));
  auto sleeper = SubmitSleeper(1);
  auto other = SubmitJob(2, 20);
  ASSERT_TRUE(other->WaitDone());
  EXPECT_EQ(scheduler_->stats().parked, 0);
  sleeper->allowed_frames = 10;
  scheduler_->Wake(sleeper.get());
  ASSERT_TRUE(sleeper->WaitDone());
  EXPECT_EQ(sleeper->restarts(), 0);
}

TEST_F(SchedulerTest, WhoIsCancelledWhileParkedEnds) {
  Start(1, {}, 0, milliseconds(0));
  auto sleeper = SubmitSleeper(1);
  auto awake = Job(2, 2);
  scheduler_->Submit(awake);
  ASSERT_TRUE(awake->WaitDone());
  sleeper->cancelled = true;
  scheduler_->Wake(sleeper.get());
  ASSERT_TRUE(sleeper->WaitDone());
  EXPECT_EQ(sleeper->failure(), ErrorCode::kCancelled);
  EXPECT_TRUE(scheduler_->WaitUntilIdle(kLong));
}

// It is stopped in the moment between seeing that a sleeper could make room and making it.
TEST_F(SchedulerTest, WhoSleepsMakesNoRoomOnceAllIsStopped) {
  Start(1, {}, 0, milliseconds(0));
  auto waiting = Job(2, 2);
  waiting->before_ready = [this] { scheduler_->Stop(false); };
  auto sleeper = Job(1, 10);
  sleeper->allowed_frames = 0;
  sleeper->before_input = [&] {
    if (scheduler_->stats().waiting > 0) return;
    scheduler_->Submit(waiting);
    scheduler_->Wake(waiting.get());
  };
  scheduler_->Submit(sleeper);
  for (const auto& job : {sleeper, waiting}) {
    ASSERT_TRUE(job->WaitDone());
    EXPECT_EQ(job->failure(), ErrorCode::kUnavailable);
  }
  EXPECT_TRUE(scheduler_->WaitUntilIdle(kLong));
}

TEST_F(SchedulerTest, GroupsAreTakenWholeOrNotAtAll) {
  Start(4, {.max_waiting = 1});
  gate_.Close();
  std::vector<std::shared_ptr<FakeJob>> jobs;
  for (uint64_t seed = 1; seed <= 4; ++seed) jobs.push_back(Job(seed, 1));
  EXPECT_EQ(CodeOf([&] {
              scheduler_->SubmitGroup({jobs.begin(), jobs.end()});
            }),
            ErrorCode::kResourceExhausted);
  EXPECT_EQ(scheduler_->stats().active + scheduler_->stats().waiting, 0);
  scheduler_->SubmitGroup({jobs.begin(), jobs.begin() + 3});
  EXPECT_EQ(scheduler_->stats().active, 2);  // half of the slots
  EXPECT_EQ(scheduler_->stats().waiting, 1);
  EXPECT_EQ(CodeOf([&] { scheduler_->SubmitGroup({jobs[3]}); }), ErrorCode::kResourceExhausted);
  gate_.Open();
  for (size_t i = 0; i < 3; ++i) ASSERT_TRUE(jobs[i]->WaitDone());
}

// Many more transitions than slots come at once, and a dance begins its next one all the same.
TEST_F(SchedulerTest, NoBurstOfGroupsKeepsADanceFromItsSlot) {
  Start(4, {.max_waiting = 100});
  gate_.Close();
  std::vector<std::shared_ptr<FakeJob>> burst;
  for (uint64_t seed = 1; seed <= 50; ++seed) burst.push_back(Job(seed, 5));
  scheduler_->SubmitGroup({burst.begin(), burst.end()});
  ASSERT_TRUE(gate_.WaitSteps(1));
  auto dance = SubmitJob(99, 1);
  ASSERT_TRUE(gate_.PassOne());
  EXPECT_THAT(gate_.steps()[1], Contains(99U));
  gate_.Open();
  for (const auto& job : burst) ASSERT_TRUE(job->WaitDone());
}

TEST_F(SchedulerTest, FailuresInARowAreCounted) {
  Start(1, {}, /*poison=*/7);
  for (int i = 1; i <= 3; ++i) {
    ASSERT_TRUE(SubmitJob(7, 1)->WaitDone());
    EXPECT_EQ(scheduler_->stats().failures, i);
  }
  ASSERT_TRUE(SubmitJob(1, 1)->WaitDone());
  EXPECT_EQ(scheduler_->stats().failures, 0);
}

TEST_F(SchedulerTest, WhatIsDueIsLoadAndWhatIsDoneAheadIsNot) {
  Start(1);
  EXPECT_EQ(scheduler_->stats().load, 0);
  gate_.Close();
  auto ahead = Job(1, 2);
  ahead->deadline = 1e12;
  scheduler_->Submit(ahead);
  ASSERT_TRUE(gate_.WaitSteps(1));
  std::this_thread::sleep_for(milliseconds(50));
  ASSERT_TRUE(gate_.PassOne());
  const double before = scheduler_->stats().load;
  std::this_thread::sleep_for(milliseconds(50));
  gate_.Open();
  ASSERT_TRUE(ahead->WaitDone());
  auto due = Job(2, 1);
  gate_.Close();
  scheduler_->Submit(due);
  ASSERT_TRUE(gate_.WaitSteps(3));
  std::this_thread::sleep_for(milliseconds(50));
  gate_.Open();
  ASSERT_TRUE(due->WaitDone());
  ASSERT_TRUE(scheduler_->WaitUntilIdle(kLong));
  auto last = SubmitJob(3, 1);  // its round tells what the one before took
  ASSERT_TRUE(last->WaitDone());
  EXPECT_LT(before, 0.01);
  EXPECT_GT(scheduler_->stats().load, 0.01);
}

}  // namespace
}  // namespace choreo
