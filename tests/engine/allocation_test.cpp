#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/engine/fake_job.h"
#include "tests/support/fake_engine.h"

// Counts this program's allocations, thread by thread. Not inlined: the compiler would see a delete
// of what malloc gave, and object.
namespace {
thread_local uint64_t allocations = 0;
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size); memory != nullptr) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace choreo::allocation_test {

// Does nothing in a step but look at the counter.
class CountingEngine : public FakeEngine {
 public:
  explicit CountingEngine(std::vector<uint64_t>* seen) : FakeEngine(8), seen_(seen) {}
  void Step(std::span<const StepInput>, std::span<StepOutput>) override {
    seen_->push_back(allocations);
  }

 private:
  std::vector<uint64_t>* seen_;
};

class CountedJob : public StepJob {
 public:
  CountedJob(TransitionSpec spec, double deadline) : spec_(std::move(spec)), deadline_(deadline) {}
  const TransitionSpec& spec() const override { return spec_; }
  bool NextInput(StepInput*) override { return true; }
  bool Ready() const override { return true; }
  void OnRestart() override { frames_ = 0; }
  bool OnFrame(const StepOutput&) override { return ++frames_ < spec_.frames; }
  void OnDone(const Error*) noexcept override {}
  double NextDeadline() const override { return deadline_ + frames_; }
  bool Cancelled() const override { return false; }

 private:
  TransitionSpec spec_;
  double deadline_;
  int frames_ = 0;
};

TEST(SchedulerAllocationTest, AFrameAllocatesNothing) {
  std::vector<uint64_t> seen;
  seen.reserve(10000);
  std::vector<std::unique_ptr<StepEngine>> engines;
  engines.push_back(std::make_unique<CountingEngine>(&seen));
  {
    // Crowded, so that rounds sort as well.
    Scheduler scheduler(std::move(engines), {.max_waiting = 0, .max_batch = 3});
    for (int i = 0; i < 8; ++i) {
      scheduler.Submit(std::make_shared<CountedJob>(MakeSpec(scheduler.model(), 1500), 0.1 * i));
    }
    ASSERT_TRUE(scheduler.WaitUntilIdle(std::chrono::minutes(1)));
  }
  // Admissions allocate, and the eight jobs come in while the first steps. They end close together.
  ASSERT_GT(seen.size(), 3500U);
  EXPECT_GT(seen.front(), 0U) << "the counter counts";
  EXPECT_EQ(seen[seen.size() - 50], seen[seen.size() - 1450]);
}

}  // namespace choreo::allocation_test
