#include <gmock/gmock.h>

#include <thread>

#include "tests/engine/scheduler_fixture.h"

namespace choreo::scheduler_slices_test {

using ::testing::ElementsAre;

constexpr uint64_t kSlice = 1'000;  // added to the seed in Gate::steps: a slice, not a step

/// Admits a transition in as many slices as it has frames; each waits at the gate. Throws in the
/// last one of the seed `poison`.
class SlicedEngine final : public GatedEngine {
 public:
  SlicedEngine(int slots, Gate* gate, uint64_t poison)
      : GatedEngine(slots, gate), poison_(poison), left_(static_cast<size_t>(slots)) {}

  int BeginAdmission(const TransitionSpec& spec) override {
    const int slot = GatedEngine::BeginAdmission(spec);
    left_[static_cast<size_t>(slot)] = spec.frames;
    return slot;
  }
  bool ContinueAdmission(int slot) override {
    gate()->Enter({kSlice + SeedOf(slot)});
    int& left = left_[static_cast<size_t>(slot)];
    if (--left == 0 && SeedOf(slot) == poison_) throw std::runtime_error("poisoned slice");
    return left > 0;
  }

 private:
  const uint64_t poison_;
  std::vector<int> left_;
};

class SlicedTest : public SchedulerTest {
 protected:
  SlicedTest() { admissions_ = 1; }

  void StartSliced(int slots, std::chrono::milliseconds max_sleep = kLong, uint64_t poison = 0) {
    std::vector<std::unique_ptr<StepEngine>> engines;
    engines.push_back(std::make_unique<SlicedEngine>(slots, &gate_, poison));
    scheduler_ = std::make_unique<Scheduler>(
        std::move(engines),
        Scheduler::Options{.max_admissions = admissions_, .max_sleep = max_sleep});
  }
  std::shared_ptr<FakeJob> SubmitBulk(uint64_t seed, int frames) {
    auto job = Job(seed, frames);
    scheduler_->SubmitGroup({job});
    return job;
  }
  // Nothing that the engine was told is left in it: all slots can be taken again.
  void ExpectRoomFor(int dances) {
    std::vector<std::shared_ptr<FakeJob>> jobs;
    for (int i = 0; i < dances; ++i) jobs.push_back(SubmitJob(50 + static_cast<uint64_t>(i), 1));
    for (const auto& job : jobs) {
      ASSERT_TRUE(job->WaitDone());
      EXPECT_EQ(job->failure(), std::nullopt);
    }
  }
};

TEST_F(SlicedTest, ADanceOvertakesAGroupsHalfMadeAdmission) {
  StartSliced(4);
  gate_.Close();
  auto bulk = SubmitBulk(1, 3);
  ASSERT_TRUE(gate_.WaitSteps(1));
  auto dance = SubmitJob(2, 2);
  gate_.Open();
  for (const auto& job : {bulk, dance}) ASSERT_TRUE(job->WaitDone());
  EXPECT_THAT(gate_.steps(),
              ElementsAre(ElementsAre(kSlice + 1), ElementsAre(kSlice + 2), ElementsAre(kSlice + 2),
                          ElementsAre(2), ElementsAre(2), ElementsAre(kSlice + 1),
                          ElementsAre(kSlice + 1), ElementsAre(1), ElementsAre(1), ElementsAre(1)));
}

// Its listener has more than `bulk_yields` in hand.
TEST_F(SlicedTest, ADanceThatIsFarAheadLetsBulkGoFirst) {
  StartSliced(4);
  gate_.Close();
  auto bulk = SubmitBulk(1, 3);
  ASSERT_TRUE(gate_.WaitSteps(1));
  auto dance = Job(2, 1);
  dance->deadline = 1e12;
  scheduler_->Submit(dance);
  gate_.Open();
  for (const auto& job : {bulk, dance}) ASSERT_TRUE(job->WaitDone());
  std::vector<uint64_t> slices;
  for (const auto& step : gate_.steps())
    if (step.front() >= kSlice) slices.push_back(step.front() - kSlice);
  EXPECT_THAT(slices, ElementsAre(1, 1, 1, 2));
}

// Bulk goes on where the dance sleeps, slice by slice, and stops when it wakes.
TEST_F(SlicedTest, BulkGoesOnWhileDancesSleep) {
  StartSliced(4);
  auto dance = Job(2, 2);
  dance->allowed_frames = 1;
  scheduler_->Submit(dance);
  ASSERT_TRUE(dance->WaitRefusals(1));
  gate_.Close();
  auto bulk = SubmitBulk(1, 4);
  ASSERT_TRUE(gate_.WaitSteps(4));  // two slices, a step, and the bulk's first slice
  ASSERT_TRUE(gate_.PassOne());
  dance->allowed_frames = 2;
  scheduler_->Wake(dance.get());
  gate_.Open();
  for (const auto& job : {bulk, dance}) ASSERT_TRUE(job->WaitDone());
  const auto steps = gate_.steps();
  ASSERT_GE(steps.size(), 7U);
  EXPECT_THAT(std::vector(steps.begin() + 3, steps.begin() + 7),
              ElementsAre(ElementsAre(kSlice + 1), ElementsAre(kSlice + 1), ElementsAre(2),
                          ElementsAre(kSlice + 1)));
}

TEST_F(SlicedTest, WhoIsCancelledGetsNoFurtherSlice) {
  StartSliced(2);
  gate_.Close();
  auto bulk = SubmitBulk(1, 100);
  ASSERT_TRUE(gate_.WaitSteps(1));
  bulk->cancelled = true;
  scheduler_->Wake(bulk.get());
  gate_.Open();
  ASSERT_TRUE(bulk->WaitDone());
  EXPECT_EQ(bulk->failure(), ErrorCode::kCancelled);
  EXPECT_EQ(gate_.steps().size(), 1U);
  ExpectRoomFor(2);
}

// A dance that is edited begins its transition again and again; what it threw away is paid for.
TEST_F(SlicedTest, HalfMadeAdmissionsOfDancesAreCharged) {
  std::vector<std::unique_ptr<StepEngine>> engines;
  engines.push_back(std::make_unique<SlicedEngine>(2, &gate_, 0));
  engines.back()->set_cost({.admission = 1e-6, .alone = 1e-6, .together = 1e-6, .slots = 2});
  scheduler_ = std::make_unique<Scheduler>(std::move(engines), Scheduler::Options{});
  const double before = scheduler_->LoadOf(30);
  for (uint64_t seed = 1; seed <= 2; ++seed) {
    gate_.Close();
    auto job = Job(seed, 100);
    seed == 1 ? scheduler_->SubmitGroup({job}) : scheduler_->Submit(job);
    ASSERT_TRUE(gate_.WaitSteps(seed));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    job->cancelled = true;
    gate_.Open();
    ASSERT_TRUE(job->WaitDone());
    if (seed == 1) {
      EXPECT_EQ(scheduler_->LoadOf(30), before) << "bulk that ends early";
    } else {
      EXPECT_GT(scheduler_->LoadOf(30), before) << "a dance";
    }
  }
}

TEST_F(SlicedTest, ASliceThatFailsEndsItsJobAlone) {
  StartSliced(2, kLong, /*poison=*/7);
  auto poisoned = SubmitJob(7, 3);
  ASSERT_TRUE(poisoned->WaitDone());
  EXPECT_EQ(poisoned->failure(), ErrorCode::kInternal);
  EXPECT_EQ(scheduler_->stats().failures, 1);
  ExpectRoomFor(2);
}

TEST_F(SlicedTest, StoppingEndsAHalfMadeAdmission) {
  StartSliced(2);
  gate_.Close();
  auto job = SubmitJob(1, 100);
  ASSERT_TRUE(gate_.WaitSteps(1));
  scheduler_->Stop(false);
  gate_.Open();
  ASSERT_TRUE(job->WaitDone());
  EXPECT_EQ(job->failure(), ErrorCode::kUnavailable);
  EXPECT_EQ(gate_.steps().size(), 1U);
  EXPECT_TRUE(scheduler_->WaitUntilIdle(kLong));
}

// A dance lost its slot while it slept, wakes in the middle of the other's admission, and is
// overtaken in the middle of its own: its bits are the same.
TEST_F(SlicedTest, WhoWasParkedIsAdmittedAnewSliceBySlice) {
  StartSliced(1, std::chrono::milliseconds(0));
  auto alone = SubmitJob(1, 3);
  ASSERT_TRUE(alone->WaitDone());
  auto parked = Job(1, 3);
  parked->allowed_frames = 1;
  scheduler_->Submit(parked);
  ASSERT_TRUE(parked->WaitRefusals(1));
  const size_t begun = gate_.steps().size();
  gate_.Close();
  auto other = SubmitJob(2, 2);
  ASSERT_TRUE(gate_.WaitSteps(begun + 1));
  EXPECT_EQ(scheduler_->stats().parked, 1);
  parked->allowed_frames = 3;
  scheduler_->Wake(parked.get());
  gate_.Open();
  for (const auto& job : {parked, other}) {
    ASSERT_TRUE(job->WaitDone());
    EXPECT_EQ(job->failure(), std::nullopt);
  }
  EXPECT_EQ(parked->restarts(), 1);
  ASSERT_EQ(parked->frames().size(), 3U);
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(parked->frames()[i].pose.rotations, alone->frames()[i].pose.rotations);
  const auto steps = gate_.steps();
  EXPECT_THAT(std::vector(steps.begin() + static_cast<std::ptrdiff_t>(begun), steps.end()),
              ElementsAre(ElementsAre(kSlice + 2), ElementsAre(kSlice + 2), ElementsAre(2),
                          ElementsAre(2), ElementsAre(kSlice + 1), ElementsAre(kSlice + 1),
                          ElementsAre(kSlice + 1), ElementsAre(1), ElementsAre(1), ElementsAre(1)));
}

// A lower bound, by construction: both are held for so long before they are admitted.
TEST_F(SlicedTest, WaitingForAdmissionIsLateness) {
  StartSliced(2);
  gate_.Close();
  auto first = SubmitJob(1, 1);
  ASSERT_TRUE(gate_.WaitSteps(1));
  auto second = SubmitJob(2, 1);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  gate_.Open();
  for (const auto& job : {first, second}) ASSERT_TRUE(job->WaitDone());
  EXPECT_GE(scheduler_->histograms().lateness_s.sum, 0.04);
}

}  // namespace choreo::scheduler_slices_test
