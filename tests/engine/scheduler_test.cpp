#include "tests/engine/scheduler_fixture.h"

#include <gmock/gmock.h>

#include <set>

namespace choreo::scheduler_test {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;
using Steps = std::vector<std::vector<uint64_t>>;

TEST_F(SchedulerTest, RunsAJobToItsEnd) {
  Start(2);
  auto job = SubmitJob(1, 7);
  ASSERT_TRUE(job->WaitDone());
  EXPECT_EQ(job->failure(), std::nullopt);
  EXPECT_EQ(job->times_done(), 1);
  ASSERT_EQ(job->frames().size(), 7U);
  ASSERT_TRUE(scheduler_->WaitUntilIdle(kLong));
  const Scheduler::Stats stats = scheduler_->stats();
  EXPECT_EQ(stats.frames, 7U);
  EXPECT_EQ(stats.steps, 7U);
  EXPECT_EQ(stats.active, 0);
  EXPECT_EQ(stats.waiting, 0);
  EXPECT_EQ(stats.slots, 2);
  EXPECT_EQ(job.use_count(), 1) << "the scheduler still holds a job that is done";
}

TEST_F(SchedulerTest, StepsReadyJobsTogether) {
  Start(4);
  HoldWorker();
  auto a = SubmitJob(1, 2), b = SubmitJob(2, 2), c = SubmitJob(3, 1);
  gate_.Open();
  for (const auto& job : {a, b, c}) ASSERT_TRUE(job->WaitDone());
  const Steps steps = gate_.steps();
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_THAT(steps[1], UnorderedElementsAre(1, 2, 3));
  EXPECT_THAT(steps[2], UnorderedElementsAre(1, 2));
}

TEST_F(SchedulerTest, TakesTheEarliestDeadlinesWhenNotAllFit) {
  Start(6, {.max_waiting = 0, .max_batch = 2});
  HoldWorker();
  std::vector<std::shared_ptr<FakeJob>> jobs;
  const double deadlines[] = {5, 1, std::numeric_limits<double>::quiet_NaN(), 4, 2};
  for (uint64_t i = 0; i < 5; ++i) {
    jobs.push_back(Job(i + 1, 1));
    jobs.back()->deadline = deadlines[i];
    scheduler_->Submit(jobs.back());
  }
  gate_.Open();
  for (const auto& job : jobs) ASSERT_TRUE(job->WaitDone());
  EXPECT_THAT(gate_.steps(),
              ElementsAre(ElementsAre(99), ElementsAre(2, 5), ElementsAre(4, 1), ElementsAre(3)));
}

// A crowd comes at once and is admitted one by one, the earliest deadline first: who dances misses
// no step.
TEST_F(SchedulerTest, ACrowdIsAdmittedOneByOneBetweenSteps) {
  admissions_ = 1;
  Start(6);
  gate_.Close();
  auto dancing = SubmitJob(1, 6);
  ASSERT_TRUE(gate_.WaitSteps(1));
  std::vector<std::shared_ptr<FakeJob>> crowd;
  const double deadlines[] = {5, 3, 4};
  for (uint64_t i = 0; i < 3; ++i) {
    crowd.push_back(Job(i + 2, 2));
    crowd.back()->deadline = deadlines[i];
    scheduler_->Submit(crowd.back());
  }
  gate_.Open();
  for (const auto& job : crowd) ASSERT_TRUE(job->WaitDone());
  ASSERT_TRUE(dancing->WaitDone());
  EXPECT_THAT(
      gate_.steps(),
      ElementsAre(ElementsAre(1), UnorderedElementsAre(1, 3), UnorderedElementsAre(1, 3, 4),
                  UnorderedElementsAre(1, 4, 2), UnorderedElementsAre(1, 2), ElementsAre(1)));
}

TEST_F(SchedulerTest, EqualDeadlinesGoInOrderOfSubmission) {
  Start(6, {.max_waiting = 0, .max_batch = 1});
  HoldWorker();
  std::vector<std::shared_ptr<FakeJob>> jobs;
  for (uint64_t i = 1; i <= 5; ++i) jobs.push_back(SubmitJob(i, 1));
  gate_.Open();
  for (const auto& job : jobs) ASSERT_TRUE(job->WaitDone());
  EXPECT_THAT(gate_.steps(), ElementsAre(ElementsAre(99), ElementsAre(1), ElementsAre(2),
                                         ElementsAre(3), ElementsAre(4), ElementsAre(5)));
}

TEST_F(SchedulerTest, ASleepingJobLeavesRoomInTheBatchAndGoesOnWhenWoken) {
  Start(3, {.max_waiting = 0, .max_batch = 1});
  auto sleeper = Job(1, 6);
  sleeper->allowed_frames = 2;
  sleeper->deadline = -1;  // first in every crowded step
  scheduler_->Submit(sleeper);
  ASSERT_TRUE(sleeper->WaitRefusals(1));
  auto other = SubmitJob(2, 5);
  ASSERT_TRUE(other->WaitDone());
  EXPECT_EQ(sleeper->times_done(), 0);
  scheduler_->Wake(sleeper.get());  // for nothing: it says no again
  ASSERT_TRUE(sleeper->WaitRefusals(2));
  sleeper->allowed_frames = 6;
  scheduler_->Wake(sleeper.get());
  ASSERT_TRUE(sleeper->WaitDone());
  EXPECT_EQ(sleeper->frames().size(), 6U);
}

TEST_F(SchedulerTest, AWakeThatComesWhileTheJobIsAskedIsNotLost) {
  Start(1);
  auto job = Job(1, 1);
  job->allowed_frames = 0;
  // The audio arrives right after the job has looked for it.
  bool first = true;
  FakeJob* raw = job.get();
  job->before_input = [&, raw] {
    if (std::exchange(first, false))
      scheduler_->Wake(raw);
    else
      raw->allowed_frames = 1;
  };
  scheduler_->Submit(job);
  ASSERT_TRUE(job->WaitDone());
  EXPECT_EQ(job->frames().size(), 1U);
}

TEST_F(SchedulerTest, WakingUnknownAndFinishedJobsDoesNothing) {
  Start(1);
  auto job = SubmitJob(1, 1);
  ASSERT_TRUE(job->WaitDone());
  const StepJob* gone = job.get();
  ASSERT_TRUE(scheduler_->WaitUntilIdle(kLong));
  job.reset();
  scheduler_->Wake(gone);
  scheduler_->Wake(nullptr);
  auto next = SubmitJob(2, 3);
  ASSERT_TRUE(next->WaitDone());
  EXPECT_EQ(next->frames().size(), 3U);
}

TEST_F(SchedulerTest, WhoWaitsGoesInOrder) {
  Start(2, {.max_batch = 1});
  auto a = SubmitSleeper(1), b = SubmitSleeper(2);
  auto c = SubmitJob(3, 1), d = SubmitJob(4, 1);
  const Scheduler::Stats stats = scheduler_->stats();
  EXPECT_EQ(stats.active, 2);
  EXPECT_EQ(stats.waiting, 2);
  a->allowed_frames = 10;
  scheduler_->Wake(a.get());
  ASSERT_TRUE(d->WaitDone());
  const Steps steps = gate_.steps();
  ASSERT_EQ(steps.size(), 12U);
  EXPECT_THAT(steps[10], ElementsAre(3));
  EXPECT_THAT(steps[11], ElementsAre(4));
}

TEST_F(SchedulerTest, OfThoseWhoWaitTheEarliestDeadlineGoesFirst) {
  Start(1, {.max_batch = 1});
  HoldWorker();
  std::vector<std::shared_ptr<FakeJob>> jobs;
  for (uint64_t i = 1; i <= 3; ++i) {
    jobs.push_back(Job(i, 1));
    jobs.back()->deadline = 10.0 - static_cast<double>(i);
    scheduler_->Submit(jobs.back());
  }
  gate_.Open();
  ASSERT_TRUE(jobs.front()->WaitDone());
  EXPECT_THAT(gate_.steps(),
              ElementsAre(ElementsAre(99), ElementsAre(3), ElementsAre(2), ElementsAre(1)));
}

TEST_F(SchedulerTest, RefusesNullAndDoubleSubmission) {
  Start(1);
  EXPECT_EQ(CodeOf([&] { scheduler_->Submit(nullptr); }), ErrorCode::kInvalidArgument);
  auto sleeper = SubmitSleeper(1);
  EXPECT_EQ(CodeOf([&] { scheduler_->Submit(sleeper); }), ErrorCode::kInvalidArgument);
}

TEST_F(SchedulerTest, RefusesUselessOptionsAndMixedEngines) {
  const auto make = [](auto... engines) {
    std::vector<std::unique_ptr<StepEngine>> list;
    (list.push_back(std::move(engines)), ...);
    return list;
  };
  struct OtherModel : FakeEngine {
    OtherModel() { model_.fingerprint = "other"; }
  };
  const auto fake = [](int slots = 1) { return std::make_unique<FakeEngine>(slots); };
  EXPECT_EQ(CodeOf([&] { Scheduler({}, {}); }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(CodeOf([&] { Scheduler(make(fake()), {.max_waiting = -1}); }),
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(CodeOf([&] { Scheduler(make(fake()), {.max_batch = 0}); }),
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(CodeOf([&] { Scheduler(make(fake()), {.max_admissions = 0}); }),
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(CodeOf([&] { Scheduler(make(fake(), std::make_unique<OtherModel>()), {}); }),
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(CodeOf([&] { Scheduler(make(fake(0)), {}); }), ErrorCode::kInvalidArgument);
  EXPECT_NO_THROW(Scheduler(make(fake(), fake()), {}));
}

TEST_F(SchedulerTest, JobsGoToTheEngineWithMostFreeSlots) {
  Gate gates[2];
  std::vector<std::unique_ptr<StepEngine>> engines;
  engines.push_back(std::make_unique<GatedEngine>(2, &gates[0], 0, "fake:0"));
  engines.push_back(std::make_unique<GatedEngine>(3, &gates[1], 0, "fake:1"));
  scheduler_ = std::make_unique<Scheduler>(std::move(engines), Scheduler::Options{});
  EXPECT_THAT(scheduler_->devices(), ElementsAre("fake:0", "fake:1"));
  // Free slots after each: 2+2, 1+2 or 2+1, ... until both are full; a sixth waits for either.
  std::vector<std::shared_ptr<FakeJob>> jobs;
  for (uint64_t i = 1; i <= 5; ++i) jobs.push_back(SubmitSleeper(i));
  auto sixth = SubmitJob(6, 2);
  EXPECT_EQ(scheduler_->stats().active, 5);
  EXPECT_EQ(scheduler_->stats().waiting, 1);
  for (const auto& job : jobs) {
    job->allowed_frames = 10;
    scheduler_->Wake(job.get());
  }
  for (const auto& job : jobs) ASSERT_TRUE(job->WaitDone());
  ASSERT_TRUE(sixth->WaitDone());
  std::set<uint64_t> seen[2];
  for (int i : {0, 1}) {
    for (const auto& step : gates[i].steps()) seen[i].insert(step.begin(), step.end());
    seen[i].erase(6);
  }
  EXPECT_EQ(seen[0].size(), 2U);
  EXPECT_EQ(seen[1].size(), 3U);
  EXPECT_TRUE(seen[1].contains(1)) << "the first job belongs where three slots are free";
}

// The whole point: what a dancer gets does not depend on who else dances.
TEST_F(SchedulerTest, OutputsAreTheSameAloneAndAmongFifteenOthers) {
  Start(16);
  auto alone = SubmitJob(7, 40);
  ASSERT_TRUE(alone->WaitDone());
  HoldWorker();
  std::vector<std::shared_ptr<FakeJob>> crowd;
  for (uint64_t i = 0; i < 8; ++i) crowd.push_back(SubmitJob(20 + i, 30 + static_cast<int>(i)));
  auto among = SubmitJob(7, 40);
  for (uint64_t i = 8; i < 15; ++i) crowd.push_back(SubmitJob(20 + i, 30 + static_cast<int>(i)));
  gate_.Open();
  ASSERT_TRUE(among->WaitDone());
  ASSERT_EQ(among->frames().size(), alone->frames().size());
  for (size_t f = 0; f < alone->frames().size(); ++f) {
    EXPECT_EQ(among->frames()[f].pose.root_position, alone->frames()[f].pose.root_position);
    EXPECT_EQ(among->frames()[f].pose.rotations, alone->frames()[f].pose.rotations);
    EXPECT_EQ(among->frames()[f].log_likelihood, alone->frames()[f].log_likelihood);
  }
  for (const auto& job : crowd) ASSERT_TRUE(job->WaitDone());
  EXPECT_NE(crowd[0]->frames()[5].pose.rotations, alone->frames()[5].pose.rotations);
}

}  // namespace choreo::scheduler_test
