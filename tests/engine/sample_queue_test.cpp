#include "model/engine/sample_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "tests/engine/sample_job.h"
#include "tests/support/expect_error.h"

namespace choreo::sample_queue_test {

using testing::ElementsAre;

constexpr double kNever = 1e12;  // seconds of the steady clock

double Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class SampleQueueTest : public testing::Test {
 protected:
  std::shared_ptr<LoggedJob> Job(const std::string& name, int slices, double deadline) {
    return std::make_shared<LoggedJob>(name, slices, deadline, &log);
  }
  /// A job whose first slice waits for `gate`, so that other jobs can arrive.
  std::shared_ptr<LoggedJob> Gate(double deadline = 0) {
    auto job = Job("gate", 1, deadline);
    job->in_slice = [this] {
      entered.set_value();
      gate.get_future().wait();
    };
    return job;
  }
  /// The worker is in the gate's slice.
  void Close(SampleQueue& queue, const std::shared_ptr<LoggedJob>& job) {
    queue.Submit(job);
    entered.get_future().wait();
  }

  JobLog log;
  std::promise<void> entered, gate;
};

TEST_F(SampleQueueTest, EarliestDeadlineGoesFirstSliceBySlice) {
  SampleQueue queue(FakeSamplers(), {});
  const auto held = Gate();
  Close(queue, held);
  const auto late = Job("late", 2, 30), early = Job("early", 2, 10), same = Job("same", 1, 10);
  for (const auto& job : {late, early, same}) queue.Submit(job);
  EXPECT_EQ(queue.stats().active, 1);
  EXPECT_EQ(queue.stats().waiting, 3);
  gate.set_value();
  for (const auto& job : {held, late, early, same}) EXPECT_FALSE(job->Result());
  EXPECT_THAT(log.all(), ElementsAre("gate", "early", "early", "same", "late", "late"));
  EXPECT_TRUE(queue.WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_EQ(queue.stats().transitions, 4U);
  EXPECT_EQ(queue.stats().frames, 40U);
}

TEST_F(SampleQueueTest, EarlierDeadlinePreemptsBetweenSlices) {
  SampleQueue queue(FakeSamplers(), {});
  const auto urgent = Job("urgent", 2, 1);
  const auto slow = Job("slow", 3, 2);
  slow->in_slice = [&, first = true]() mutable {
    if (std::exchange(first, false)) queue.Submit(urgent);
  };
  queue.Submit(slow);
  EXPECT_FALSE(slow->Result());
  EXPECT_THAT(log.all(), ElementsAre("slow", "urgent", "urgent", "slow", "slow"));
}

TEST_F(SampleQueueTest, DueDancesGoBeforeBulkAndBulkBeforeOthers) {
  SampleQueue queue(FakeSamplers(), {});
  const auto held = Gate();
  Close(queue, held);
  const auto bulk = Job("bulk", 2, 0), soon = Job("soon", 1, Now() + 0.5);
  const auto ahead = Job("ahead", 1, kNever);
  queue.SubmitBulk(bulk);
  queue.Submit(ahead);
  queue.Submit(soon);
  gate.set_value();
  for (const auto& job : {bulk, ahead, soon}) EXPECT_FALSE(job->Result());
  EXPECT_THAT(log.all(), ElementsAre("gate", "soon", "bulk", "bulk", "ahead"));
}

// An invalid deadline gives no priority.
TEST_F(SampleQueueTest, NanDeadlineIsNever) {
  SampleQueue queue(FakeSamplers(), {});
  const auto held = Gate();
  Close(queue, held);
  const auto nan = Job("nan", 1, std::numeric_limits<double>::quiet_NaN());
  const auto other = Job("other", 1, 5);
  queue.Submit(nan);
  queue.Submit(other);
  gate.set_value();
  EXPECT_FALSE(nan->Result());
  EXPECT_THAT(log.all(), ElementsAre("gate", "other", "nan"));
}

TEST_F(SampleQueueTest, CancelledJobsEndInAnyState) {
  SampleQueue queue(FakeSamplers(), {});
  const auto held = Gate(/*deadline=*/5);
  const auto begun = Job("begun", 100, 10), waiting = Job("waiting", 100, 20);
  begun->in_slice = [&, first = true]() mutable {
    if (std::exchange(first, false)) queue.Submit(held);
  };
  queue.Submit(begun);
  entered.get_future().wait();
  queue.Submit(waiting);
  begun->cancelled = waiting->cancelled = true;
  queue.CheckCancelled();
  gate.set_value();
  for (const auto& job : {begun, waiting}) {
    const std::optional<Error> failure = job->Result();
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->code(), ErrorCode::kCancelled);
  }
  EXPECT_FALSE(held->Result());
  EXPECT_THAT(log.all(), ElementsAre("begun", "gate"));
  EXPECT_TRUE(queue.WaitUntilIdle(std::chrono::seconds(30)));
}

TEST_F(SampleQueueTest, ExceptionEndsOnlyItsJob) {
  SampleQueue queue(FakeSamplers(), {});
  const auto fail = [&](const std::function<void()>& thrower) {
    const auto job = Job("job", 5, 0);
    job->in_slice = thrower;
    queue.Submit(job);
    return *job->Result();
  };
  const Error refused = fail([] { throw InvalidArgument("field", "is wrong"); });
  EXPECT_EQ(refused.code(), ErrorCode::kInvalidArgument);
  EXPECT_EQ(queue.stats().failures, 0) << "its own fault";
  for (int i = 1; i <= 3; ++i) {
    EXPECT_EQ(fail([] { throw std::runtime_error("the device is gone"); }).code(),
              ErrorCode::kInternal);
    EXPECT_TRUE(queue.WaitUntilIdle(std::chrono::seconds(30)));
    EXPECT_EQ(queue.stats().failures, i);
  }
  const auto job = Job("job", 2, 0);
  queue.Submit(job);
  EXPECT_FALSE(job->Result());
  EXPECT_TRUE(queue.WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_EQ(queue.stats().failures, 0);
}

TEST_F(SampleQueueTest, AJobMaySubmitTheNext) {
  SampleQueue queue(FakeSamplers(), {});
  const auto next = Job("next", 1, 0), first = Job("first", 1, 0);
  first->at_end = [&] { queue.Submit(next); };
  queue.Submit(first);
  EXPECT_FALSE(next->Result());
}

TEST_F(SampleQueueTest, StopEndsAllJobsAndTakesNone) {
  SampleQueue queue(FakeSamplers(), {});
  const auto held = Gate(), waiting = Job("waiting", 1, 0);
  Close(queue, held);
  queue.SubmitBulk(waiting);
  queue.Stop();
  ExpectError(ErrorCode::kUnavailable, "takes no new jobs",
              [&] { queue.Submit(Job("late", 1, 0)); });
  gate.set_value();
  EXPECT_EQ(waiting->Result()->code(), ErrorCode::kUnavailable);
  EXPECT_TRUE(queue.WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_THAT(log.all(), ElementsAre("gate"));
}

TEST_F(SampleQueueTest, BulkRoomIsLimitedAndFreed) {
  auto queue = std::make_unique<SampleQueue>(FakeSamplers(), SampleQueue::Options{.max_bulk = 5});
  SampleQueue::Reservation three = queue->ReserveBulk(3);
  ExpectError(ErrorCode::kResourceExhausted,
              "3 transitions are in progress or wait already; with 3 more there would be more than "
              "5",
              [&] { queue->ReserveBulk(3); });
  const auto two = queue->ReserveBulk(2);
  three.reset();
  three = queue->ReserveBulk(3);
  queue.reset();  // they may outlive it
}

TEST_F(SampleQueueTest, WorkersShareWaitingJobs) {
  SampleQueue queue(FakeSamplers(3), {});
  EXPECT_EQ(queue.stats().workers, 3);
  EXPECT_EQ(queue.devices().size(), 3U);
  std::promise<void> all;
  std::atomic<int> here = 0;
  std::vector<std::shared_ptr<LoggedJob>> jobs;
  const std::shared_future<void> open = all.get_future().share();
  for (int i = 0; i < 3; ++i) {
    jobs.push_back(Job("job", 1, 0));
    jobs.back()->in_slice = [&here, &all, open] {
      if (++here == 3) all.set_value();
      open.wait();  // for the two others, which other workers have begun
    };
    queue.Submit(jobs.back());
  }
  for (const auto& job : jobs) EXPECT_FALSE(job->Result());
}

TEST_F(SampleQueueTest, LatenessCountsFromDeadlineOrRequest) {
  SampleQueue queue(FakeSamplers(), {});
  const auto lateness = [&] { return queue.histograms().lateness_s; };
  const auto early = Job("early", 1, kNever);
  queue.Submit(early);
  EXPECT_FALSE(early->Result());
  EXPECT_EQ(lateness().sum, 0);
  // The deadline of this job had passed long before it was submitted.
  const auto late = Gate();
  const double before = Now();
  Close(queue, late);
  const double held = Now();
  while (Now() == held) continue;
  const double opened = Now();
  gate.set_value();
  EXPECT_FALSE(late->Result());
  EXPECT_GE(lateness().sum, opened - held);
  EXPECT_LE(lateness().sum, Now() - before);
  const Histogram::Snapshot both = lateness();
  EXPECT_EQ(std::accumulate(both.counts.begin(), both.counts.end(), 0U), 2U);
}

TEST_F(SampleQueueTest, RefusesInvalidOptions) {
  ExpectError(ErrorCode::kInvalidArgument, "samplers", [] { SampleQueue({}, {}); });
  ExpectError(ErrorCode::kInvalidArgument, "max_bulk",
              [] { SampleQueue(FakeSamplers(), {.max_bulk = -1}); });
  auto different = FakeSamplers();
  different.push_back(std::make_unique<ControlledSampler>("other"));
  ExpectError(ErrorCode::kInvalidArgument, "samplers[1]",
              [&] { SampleQueue(std::move(different), {}); });
  SampleQueue queue(FakeSamplers(), {});
  ExpectError(ErrorCode::kInvalidArgument, "job", [&] { queue.Submit(nullptr); });
}

}  // namespace choreo::sample_queue_test
