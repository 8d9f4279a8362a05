#include "tests/engine/scheduler_fixture.h"

#include <gmock/gmock.h>

namespace choreo::scheduler_chain_test {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

// So are the transitions that follow on others which end together.
TEST_F(SchedulerTest, ChainsThatEndTogetherGoOnOneByOne) {
  admissions_ = 1;
  Start(6);
  gate_.Close();
  auto dancing = SubmitJob(1, 7);
  ASSERT_TRUE(gate_.WaitSteps(1));
  std::vector<std::shared_ptr<FakeJob>> first, next;
  for (uint64_t i = 0; i < 2; ++i) {
    first.push_back(Job(i + 2, i == 0 ? 2 : 1));
    next.push_back(Job(i + 12, 2));
    first.back()->when_done = [this, follower = next.back()](const Error*) {
      scheduler_->Submit(follower);
    };
    scheduler_->Submit(first.back());
  }
  gate_.Open();
  for (const auto& job : next) ASSERT_TRUE(job->WaitDone());
  ASSERT_TRUE(dancing->WaitDone());
  EXPECT_THAT(gate_.steps(),
              ElementsAre(ElementsAre(1), UnorderedElementsAre(1, 2), UnorderedElementsAre(1, 2, 3),
                          UnorderedElementsAre(1, 12), UnorderedElementsAre(1, 12, 13),
                          UnorderedElementsAre(1, 13), ElementsAre(1)));
}

// Its next transition is due before the rival, the one after that is not.
TEST_F(SchedulerTest, AChainKeepsItsSlotWhileItIsDueFirst) {
  Start(1, {.max_batch = 1});
  HoldWorker();
  auto first = Job(1, 2), second = Job(2, 2), third = Job(3, 2);
  third->deadline = 2;
  first->when_done = [&](const Error*) { scheduler_->Submit(second); };
  second->when_done = [&](const Error*) { scheduler_->Submit(third); };
  scheduler_->Submit(first);
  ASSERT_TRUE(gate_.PassOne());  // 99 is done, first stands at the gate
  auto rival = Job(50, 1);
  rival->deadline = 1;
  scheduler_->Submit(rival);
  EXPECT_EQ(scheduler_->stats().waiting, 1);
  gate_.Open();
  ASSERT_TRUE(third->WaitDone());
  EXPECT_THAT(gate_.steps(),
              ElementsAre(ElementsAre(99), ElementsAre(1), ElementsAre(1), ElementsAre(2),
                          ElementsAre(2), ElementsAre(50), ElementsAre(3), ElementsAre(3)));
}

TEST_F(SchedulerTest, AChainMissesNoStep) {
  Start(3);
  HoldWorker();
  auto neighbour = SubmitJob(1, 4);
  auto first = Job(2, 2), second = Job(3, 2);
  first->when_done = [&](const Error*) { scheduler_->Submit(second); };
  scheduler_->Submit(first);
  gate_.Open();
  ASSERT_TRUE(neighbour->WaitDone());
  ASSERT_TRUE(second->WaitDone());
  EXPECT_THAT(gate_.steps(),
              ElementsAre(ElementsAre(99), UnorderedElementsAre(1, 2), UnorderedElementsAre(1, 2),
                          UnorderedElementsAre(1, 3), UnorderedElementsAre(1, 3)));
}

TEST_F(SchedulerTest, AJobMayBeSubmittedAgainFromItsOwnEnd) {
  Start(1);
  std::vector<int> lengths;
  auto job = Job(1, 3);
  FakeJob* raw = job.get();
  std::weak_ptr<FakeJob> weak = job;
  std::atomic<int> runs = 0;
  job->when_done = [&, raw](const Error*) {
    lengths.push_back(static_cast<int>(raw->frames().size()));
    if (++runs < 3) scheduler_->Submit(weak.lock());
  };
  scheduler_->Submit(job);
  ASSERT_TRUE(scheduler_->WaitUntilIdle(kLong));
  EXPECT_EQ(job->times_done(), 3);
  EXPECT_THAT(lengths, ElementsAre(3, 4, 5));  // after its third frame it always says: enough
}

TEST_F(SchedulerTest, OnlyTheFirstFollowUpInherits) {
  Start(1, {.max_batch = 1});
  HoldWorker();
  auto parent = Job(1, 1), heir = Job(2, 1), sibling = Job(3, 1);
  parent->when_done = [&](const Error*) {
    scheduler_->Submit(heir);
    scheduler_->Submit(sibling);
  };
  scheduler_->Submit(parent);
  auto rival = Job(50, 1);
  rival->deadline = 1;
  sibling->deadline = 2;
  scheduler_->Submit(rival);
  gate_.Open();
  ASSERT_TRUE(sibling->WaitDone());
  EXPECT_THAT(gate_.steps(), ElementsAre(ElementsAre(99), ElementsAre(1), ElementsAre(2),
                                         ElementsAre(50), ElementsAre(3)));
}

}  // namespace choreo::scheduler_chain_test
