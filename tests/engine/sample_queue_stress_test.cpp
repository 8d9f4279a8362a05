#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "tests/engine/sample_job.h"

namespace choreo::sample_queue_stress_test {

// Dances and bulk that come, fail and are cancelled at any moment, from several threads: each ends
// once, and all room comes back.
TEST(SampleQueueStress, EveryJobEndsOnce) {
  constexpr int kThreads = 4, kRounds = 200;
  SampleQueue queue(FakeSamplers(3), {.max_bulk = 16});
  std::atomic<int> finished = 0, failed = 0, cancelled = 0, refused = 0;
  std::vector<std::jthread> threads;
  for (uint32_t thread = 0; thread < kThreads; ++thread) {
    threads.emplace_back([&, thread] {
      std::mt19937 random(thread);
      for (int round = 0; round < kRounds; ++round) {
        const bool is_bulk = random() % 2 == 0;
        SampleQueue::Reservation room;
        if (is_bulk) {
          try {
            room = queue.ReserveBulk(1 + static_cast<int>(random() % 8));
          } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kResourceExhausted);
            ++refused;
            continue;
          }
        }
        const auto job = std::make_shared<LoggedJob>("job", 1 + static_cast<int>(random() % 20),
                                                     static_cast<double>(random() % 100), nullptr);
        const bool fails = random() % 5 == 0;
        if (fails) job->in_slice = [] { throw std::runtime_error("lost"); };
        is_bulk ? queue.SubmitBulk(job) : queue.Submit(job);
        if (random() % 3 == 0) {
          job->cancelled = true;
          queue.CheckCancelled();
        }
        const std::optional<Error> failure = job->Result();
        if (!failure) {
          ++finished;
        } else {
          ++(failure->code() == ErrorCode::kCancelled ? cancelled : failed);
        }
      }
    });
  }
  threads.clear();
  EXPECT_EQ(finished + failed + cancelled + refused, kThreads * kRounds);
  EXPECT_GT(finished, 0);
  EXPECT_GT(failed, 0);
  EXPECT_TRUE(queue.WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_EQ(queue.stats().active + queue.stats().waiting, 0);
  EXPECT_EQ(queue.stats().transitions, static_cast<uint64_t>(finished));
  queue.ReserveBulk(16);
}

}  // namespace choreo::sample_queue_stress_test
