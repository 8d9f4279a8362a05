#include "tests/engine/scheduler_fixture.h"

namespace choreo::scheduler_end_test {

TEST_F(SchedulerTest, CancellingARunningJobGivesItsSlotToTheNext) {
  Start(1);
  gate_.Close();
  auto running = SubmitJob(1, 1000);
  auto next = SubmitJob(2, 2);
  ASSERT_TRUE(gate_.PassOne());
  running->cancelled = true;
  gate_.Open();
  ASSERT_TRUE(running->WaitDone());
  ASSERT_TRUE(next->WaitDone());
  EXPECT_EQ(running->failure(), ErrorCode::kCancelled);
  EXPECT_LE(running->frames().size(), 2U);
  EXPECT_EQ(next->failure(), std::nullopt);
}

TEST_F(SchedulerTest, CancellingASleepingJobFreesItsSlotAtOnce) {
  Start(1);
  auto sleeper = SubmitSleeper(1);
  auto next = SubmitJob(2, 2);
  sleeper->cancelled = true;
  scheduler_->Wake(sleeper.get());
  ASSERT_TRUE(next->WaitDone());
  ASSERT_TRUE(sleeper->WaitDone());
  EXPECT_EQ(sleeper->failure(), ErrorCode::kCancelled);
}

TEST_F(SchedulerTest, CancellingAWaitingJobFreesItsPlace) {
  Start(1, {.max_batch = 1});
  auto sleeper = SubmitSleeper(1);
  auto first = SubmitJob(2, 2), second = SubmitJob(3, 2);
  EXPECT_EQ(scheduler_->stats().waiting, 2);
  first->cancelled = true;
  scheduler_->Wake(first.get());
  ASSERT_TRUE(first->WaitDone());
  EXPECT_EQ(first->failure(), ErrorCode::kCancelled);
  EXPECT_EQ(scheduler_->stats().waiting, 1);
  auto third = SubmitJob(4, 2);  // there is room again
  sleeper->allowed_frames = 10;
  scheduler_->Wake(sleeper.get());
  ASSERT_TRUE(second->WaitDone());
  ASSERT_TRUE(third->WaitDone());
  EXPECT_EQ(second->failure(), std::nullopt);
}

TEST_F(SchedulerTest, AFailingStepFailsItsBatchAndTheWorkerLivesOn) {
  Start(4, {}, /*poison=*/13);
  HoldWorker();
  auto mate = SubmitJob(1, 3), poisoned = SubmitJob(13, 3);
  gate_.Open();
  ASSERT_TRUE(mate->WaitDone());
  ASSERT_TRUE(poisoned->WaitDone());
  EXPECT_EQ(mate->failure(), ErrorCode::kInternal);
  EXPECT_EQ(poisoned->failure(), ErrorCode::kInternal);
  auto later = SubmitJob(2, 3);
  ASSERT_TRUE(later->WaitDone());
  EXPECT_EQ(later->failure(), std::nullopt);
  ASSERT_TRUE(scheduler_->WaitUntilIdle(kLong));
  EXPECT_EQ(scheduler_->stats().active, 0);
}

TEST_F(SchedulerTest, ARefusedSpecFailsItsJobAndItsPlaceGoesOn) {
  Start(1);
  auto sleeper = SubmitSleeper(1);
  auto bad = SubmitJob(2, 0), good = SubmitJob(3, 2);
  sleeper->cancelled = true;
  scheduler_->Wake(sleeper.get());
  ASSERT_TRUE(good->WaitDone());
  EXPECT_EQ(bad->failure(), ErrorCode::kInvalidArgument);
  EXPECT_EQ(good->failure(), std::nullopt);
}

TEST_F(SchedulerTest, AThrowingJobFailsAlone) {
  Start(4);
  HoldWorker();
  auto healthy = SubmitJob(1, 5);
  auto bad_frame = Job(2, 5), bad_input = Job(3, 5);
  bad_frame->on_frame = [] { throw std::runtime_error("frame"); };
  bad_input->before_input = [] { throw Error(ErrorCode::kOutOfRange, "audio", "gap"); };
  scheduler_->Submit(bad_frame);
  scheduler_->Submit(bad_input);
  gate_.Open();
  for (const auto& job : {healthy, bad_frame, bad_input}) ASSERT_TRUE(job->WaitDone());
  EXPECT_EQ(healthy->failure(), std::nullopt);
  EXPECT_EQ(healthy->frames().size(), 5U);
  EXPECT_EQ(bad_frame->failure(), ErrorCode::kInternal);
  EXPECT_EQ(bad_input->failure(), ErrorCode::kOutOfRange);
}

TEST_F(SchedulerTest, DrainingFinishesWhatWasAcceptedAndChains) {
  Start(1);
  HoldWorker();
  auto first = Job(1, 2), second = Job(2, 2);
  first->when_done = [&](const Error*) { scheduler_->Submit(second); };
  scheduler_->Submit(first);
  auto waiting = SubmitJob(3, 2);
  scheduler_->Stop(true);
  scheduler_->Stop(true);
  EXPECT_EQ(CodeOf([&] { scheduler_->Submit(Job(4, 1)); }), ErrorCode::kUnavailable);
  EXPECT_FALSE(scheduler_->WaitUntilIdle(std::chrono::milliseconds(1)));
  gate_.Open();
  ASSERT_TRUE(scheduler_->WaitUntilIdle(kLong));
  for (const auto& job : {first, second, waiting}) {
    EXPECT_EQ(job->failure(), std::nullopt);
    EXPECT_EQ(job->frames().size(), 2U);
  }
}

TEST_F(SchedulerTest, AHardStopEndsRunningSleepingAndWaitingJobs) {
  Start(2);
  auto sleeper = SubmitSleeper(1);
  gate_.Close();
  auto running = SubmitJob(2, 1000), waiting = SubmitJob(3, 1);
  ASSERT_TRUE(gate_.WaitSteps(1));
  auto follow_up = Job(4, 1);
  std::optional<ErrorCode> refused;
  running->when_done = [&](const Error*) {
    refused = CodeOf([&] { scheduler_->Submit(follow_up); });
  };
  scheduler_->Stop(true);
  scheduler_->Stop(false);
  scheduler_->Stop(true);  // does not soften it
  gate_.Open();
  ASSERT_TRUE(scheduler_->WaitUntilIdle(kLong));
  for (const auto& job : {sleeper, running, waiting}) {
    EXPECT_EQ(job->failure(), ErrorCode::kUnavailable);
    EXPECT_EQ(job->times_done(), 1);
  }
  EXPECT_EQ(refused, ErrorCode::kUnavailable);
  EXPECT_EQ(CodeOf([&] { scheduler_->Submit(follow_up); }), ErrorCode::kUnavailable);
}

TEST_F(SchedulerTest, DestructionEndsEveryJobOnce) {
  Start(1);
  auto sleeper = SubmitSleeper(1);
  auto waiting = SubmitJob(2, 5);
  scheduler_.reset();
  EXPECT_EQ(sleeper->times_done(), 1);
  EXPECT_EQ(waiting->times_done(), 1);
  EXPECT_EQ(waiting->failure(), ErrorCode::kUnavailable);
}

}  // namespace choreo::scheduler_end_test
