#include <gtest/gtest.h>

#include <thread>

#include "model/core/random.h"
#include "tests/engine/fake_job.h"
#include "tests/support/fake_engine.h"

namespace choreo::scheduler_stress_test {

// Throws now and then, as a device may.
class FlakyEngine : public FakeEngine {
 public:
  FlakyEngine(int slots, uint64_t seed) : FakeEngine(slots), random_(seed) {}
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override {
    if (random_.Integer(0, 50) == 0) throw std::runtime_error("flaky");
    FakeEngine::Step(in, out);
  }

 private:
  Random random_;
};

// Several threads submit, wake, cancel and ask at random while jobs chain, fail and sleep. Whatever
// the order, each accepted job ends exactly once and no slot is lost. Meant for the thread
// sanitizer, too.
TEST(SchedulerStressTest, EveryAcceptedJobEndsExactlyOnce) {
  for (const bool drain : {true, false}) {
    std::vector<std::unique_ptr<StepEngine>> engines;
    for (uint64_t i = 0; i < 2; ++i) engines.push_back(std::make_unique<FlakyEngine>(4, i));
    Scheduler scheduler(
        std::move(engines),
        {.max_waiting = 8, .max_batch = 3, .max_sleep = std::chrono::milliseconds(1)});

    std::atomic<int> accepted = 0, refused = 0, ended = 0, completed = 0;
    const auto client = [&](uint32_t stream) {
      Random random(drain ? 1 : 2, stream);
      std::vector<std::shared_ptr<FakeJob>> mine;
      const auto make = [&] {
        const int frames = static_cast<int>(random.Integer(0, 8));  // 0 is refused by the engine
        auto job = std::make_shared<FakeJob>(MakeSpec(scheduler.model(), frames, stream + 1));
        job->allowed_frames = static_cast<int>(random.Integer(0, 6));
        job->deadline = random.Uniform();
        if (random.Integer(0, 10) == 0) job->on_frame = [] { throw std::runtime_error("job"); };
        return job;
      };
      const auto submit = [&](const std::shared_ptr<FakeJob>& job, bool of_group) {
        try {
          if (of_group) {
            scheduler.SubmitGroup({job});
          } else {
            scheduler.Submit(job);
          }
          ++accepted;
        } catch (const Error&) {
          ++refused;
          std::this_thread::yield();
        }
      };
      const auto count = [&](const Error* failure) {
        ++ended;
        completed += failure == nullptr;
      };
      for (int i = 0; i < 300; ++i) {
        auto job = make();
        job->when_done = count;
        if (random.Integer(0, 2) == 0) {
          auto next = make();
          next->when_done = count;
          mine.push_back(next);
          job->when_done = [&, next, submit, count](const Error* failure) {
            count(failure);
            submit(next, false);
          };
        }
        mine.push_back(job);
        submit(job, random.Integer(0, 2) == 0);
        for (int k = 0; k < 3; ++k) {
          FakeJob& some =
              *mine[static_cast<size_t>(random.Integer(0, static_cast<int64_t>(mine.size())))];
          some.allowed_frames = 100;
          if (random.Integer(0, 4) == 0) some.cancelled = true;
          scheduler.Wake(&some);
        }
        if (!drain && stream == 0 && i == 150) scheduler.Stop(false);
        const Scheduler::Stats stats = scheduler.stats();
        EXPECT_LE(stats.active, stats.slots);
      }
      // Nobody stays asleep, neither those that run nor those whose chain has not come to them yet.
      for (const auto& job : mine) {
        job->allowed_frames = 100;
        scheduler.Wake(job.get());
      }
    };
    std::vector<std::thread> clients;
    for (uint32_t i = 0; i < 4; ++i) clients.emplace_back(client, i);
    for (std::thread& thread : clients) thread.join();
    scheduler.Stop(true);
    ASSERT_TRUE(scheduler.WaitUntilIdle(std::chrono::minutes(1)));
    EXPECT_EQ(ended, accepted);
    EXPECT_GT(completed, 0);
    EXPECT_GT(refused, 0);
    EXPECT_EQ(scheduler.stats().active, 0);
    EXPECT_EQ(scheduler.stats().waiting, 0);
  }
}

}  // namespace choreo::scheduler_stress_test
