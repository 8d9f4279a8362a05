#include <gmock/gmock.h>

#include <algorithm>
#include <iostream>

#include "tests/engine/scheduler_fixture.h"

namespace choreo::scheduler_room_test {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

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

// A dance whose next frame is due is stepped without the groups beside it; one that is far ahead of
// its music is begun after them, and stepped with them.
TEST_F(SchedulerTest, GroupsYieldToDancesThatAreDue) {
  Start(4);
  HoldWorker();
  auto group = Job(1, 2);
  scheduler_->SubmitGroup({group});
  auto due = SubmitJob(2, 2);
  auto ahead = Job(3, 3);
  ahead->deadline = 1e12;
  scheduler_->Submit(ahead);
  gate_.Open();
  for (const auto& job : {group, due, ahead}) ASSERT_TRUE(job->WaitDone());
  EXPECT_THAT(gate_.steps(),
              ElementsAre(ElementsAre(99), ElementsAre(2), ElementsAre(2),
                          UnorderedElementsAre(1, 3), UnorderedElementsAre(1, 3), ElementsAre(3)));
  int due_steps = 0, shared = 0;
  for (const auto& step : gate_.steps()) {
    if (std::ranges::find(step, 2) == step.end()) continue;
    ++due_steps;
    shared += static_cast<int>(std::ranges::count(step, 1));
  }
  std::cout << due_steps << " steps with a dance that is due, " << shared
            << " of them with a transition\n";
}

TEST_F(SchedulerTest, DancesThatAreDueAreAdmittedBeforeGroups) {
  admissions_ = 1;
  Start(4);
  HoldWorker();
  std::vector<std::shared_ptr<StepJob>> group = {Job(1, 5), Job(2, 5)};
  scheduler_->SubmitGroup(group);
  auto due = Job(3, 1);
  due->deadline = 1;  // later than the group's, and long past
  scheduler_->Submit(due);
  gate_.Open();
  ASSERT_TRUE(due->WaitDone());
  EXPECT_THAT(gate_.steps()[1], ElementsAre(3));
}

// Two engines share what comes.
TEST(SchedulerLoadTest, FollowsFromWhatTheWarmUpMeasured) {
  std::vector<std::unique_ptr<StepEngine>> engines;
  for (int i = 0; i < 2; ++i) {
    engines.push_back(std::make_unique<FakeEngine>(64));
    engines.back()->set_cost({.admission = 1e-3, .alone = 2e-3, .together = 5e-3, .slots = 4});
  }
  const Scheduler scheduler(std::move(engines), {});
  EXPECT_EQ(scheduler.LoadOf(0), 0);
  EXPECT_NEAR(scheduler.LoadOf(30), 0.5 * 30 * (2e-3 + 1e-3), 1e-9);
  EXPECT_NEAR(scheduler.LoadOf(8 * 30), 30 * (5e-3 + 4 * 1e-3), 1e-9);
  const Scheduler unknown(
      [] {
        std::vector<std::unique_ptr<StepEngine>> one;
        one.push_back(std::make_unique<FakeEngine>());
        return one;
      }(),
      {});
  EXPECT_EQ(unknown.LoadOf(1e6), 0);
}

}  // namespace choreo::scheduler_room_test
