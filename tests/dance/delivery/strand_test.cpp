#include "model/dance/delivery/strand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "model/dance/delivery/hand_over.h"
#include "tests/support/fake_sampler.h"

namespace choreo::strand_test {

using testing::ElementsAre;
using testing::IsEmpty;

/// Numbers that a Strand hands out.
class Numbers {
 public:
  /// Called with each number before it is in `taken`, and with none where there is no next one.
  std::function<void(std::optional<int>)> in_take = [](std::optional<int>) {};
  std::vector<int> taken;
  std::vector<std::thread::id> takers;  // of `taken`

  void Add(int number) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(number);
  }
  bool HandOut(int most = 100) {
    return strand_.Run(
        mutex_, most, [this] { return Next(); },
        [this](std::optional<int> number) {
          in_take(number);
          if (!number) return;
          taken.push_back(*number);
          takers.push_back(std::this_thread::get_id());
        });
  }

 private:
  std::optional<int> Next() {
    if (waiting_.empty()) return std::nullopt;
    const int next = waiting_.front();
    waiting_.pop_front();
    return next;
  }

  std::mutex mutex_;
  Strand strand_;
  std::deque<int> waiting_;
};

class StrandTest : public testing::Test {
 protected:
  /// A thread that hands out, and waits for `gate` when it takes `number` for the first time.
  std::thread HandOutUpTo(std::optional<int> number) {
    numbers.in_take = [this, number, is_open = false](std::optional<int> taken) mutable {
      if (taken != number || std::exchange(is_open, true)) return;
      entered.set_value();
      gate.get_future().wait();
    };
    std::thread thread([this] { numbers.HandOut(); });
    entered.get_future().wait();
    return thread;
  }

  Numbers numbers;
  std::promise<void> entered, gate;
};

TEST_F(StrandTest, OneThreadTakesWhatOthersAsk) {
  numbers.Add(1);
  numbers.Add(2);
  std::thread first = HandOutUpTo(1);
  const std::thread::id id = first.get_id();
  numbers.Add(3);
  EXPECT_FALSE(numbers.HandOut()) << "the other thread has it, and this one does not wait";
  EXPECT_THAT(numbers.taken, IsEmpty());
  gate.set_value();
  first.join();
  EXPECT_THAT(numbers.taken, ElementsAre(1, 2, 3));
  EXPECT_THAT(numbers.takers, ElementsAre(id, id, id));
}

TEST_F(StrandTest, AskingWhenNothingSeemsLeftIsNotLost) {
  std::thread first = HandOutUpTo(std::nullopt);
  numbers.Add(1);
  EXPECT_FALSE(numbers.HandOut());
  gate.set_value();
  first.join();
  EXPECT_THAT(numbers.taken, ElementsAre(1));
}

TEST_F(StrandTest, TakesAtMostSoMany) {
  for (const int number : {1, 2, 3}) numbers.Add(number);
  EXPECT_TRUE(numbers.HandOut(2));
  EXPECT_THAT(numbers.taken, ElementsAre(1, 2));
  EXPECT_FALSE(numbers.HandOut(2)) << "one number, and then none";
  EXPECT_THAT(numbers.taken, ElementsAre(1, 2, 3));
}

TEST_F(StrandTest, ATakeMayAskAgain) {
  numbers.Add(1);
  numbers.Add(2);
  numbers.in_take = [this](std::optional<int>) { EXPECT_FALSE(numbers.HandOut()); };
  EXPECT_TRUE(numbers.HandOut(3)) << "the last take asked";
  EXPECT_THAT(numbers.taken, ElementsAre(1, 2));
}

TEST_F(StrandTest, WhatATakeThrowsPassesAndTheRestWaits) {
  for (const int number : {1, 2, 3}) numbers.Add(number);
  numbers.in_take = [](std::optional<int> number) {
    if (number == 2) throw std::runtime_error("two");
  };
  EXPECT_THROW(numbers.HandOut(), std::runtime_error);
  EXPECT_THAT(numbers.taken, ElementsAre(1));
  EXPECT_FALSE(numbers.HandOut());
  EXPECT_THAT(numbers.taken, ElementsAre(1, 3)) << "nobody gets the one that failed again";
}

/// Has a worker hand out numbers, one in each slice.
class Owner : public std::enable_shared_from_this<Owner> {
 public:
  Numbers numbers;
  bool cancelled = false;
  std::vector<ErrorCode> failures;
  bool refuses_jobs = false, has_memory = true;

  /// `jobs`: gets those that are submitted.
  explicit Owner(std::vector<std::shared_ptr<SampleJob>>* jobs) : jobs_(jobs) {}

  bool HandOut() { return numbers.HandOut(1); }
  HandOver<Owner>& hand_over() { return hand_over_; }
  bool Cancelled() const { return cancelled; }
  void OnFailure(const Error& failure) noexcept { failures.push_back(failure.code()); }

  void Ask() {
    hand_over_.ToWorker(shared_from_this(), 5, [this](std::shared_ptr<SampleJob> job) {
      if (refuses_jobs) throw Error(ErrorCode::kUnavailable, "", "takes no new jobs");
      if (!has_memory) throw std::bad_alloc();
      jobs_->push_back(std::move(job));
    });
  }

 private:
  std::vector<std::shared_ptr<SampleJob>>* jobs_;
  HandOver<Owner> hand_over_;
};

class HandOverTest : public testing::Test {
 protected:
  HandOverTest() {
    for (const int number : {1, 2}) owner->numbers.Add(number);
  }

  std::vector<std::shared_ptr<SampleJob>> jobs;
  const std::shared_ptr<Owner> owner = std::make_shared<Owner>(&jobs);
  ControlledSampler sampler;
};

TEST_F(HandOverTest, OneJobAtATimeHandsOutAll) {
  owner->Ask();
  owner->Ask();
  ASSERT_EQ(jobs.size(), 1U);
  SampleJob& job = *jobs[0];
  EXPECT_EQ(job.Deadline(), 5);
  EXPECT_TRUE(job.Continue(sampler));
  owner->Ask();
  EXPECT_EQ(jobs.size(), 1U) << "it goes on by itself";
  EXPECT_TRUE(job.Continue(sampler));
  EXPECT_FALSE(job.Continue(sampler));
  EXPECT_THAT(owner->numbers.taken, ElementsAre(1, 2));
  job.OnDone(nullptr);
  owner->Ask();
  EXPECT_EQ(jobs.size(), 2U) << "the first one is over";
  EXPECT_THAT(owner->failures, IsEmpty());
}

// The job that asked in its own slice leaves the rest to the next one.
TEST_F(HandOverTest, AJobThatIsRelievedEnds) {
  owner->Ask();
  owner->numbers.in_take = [this](std::optional<int>) { owner->Ask(); };
  EXPECT_FALSE(jobs[0]->Continue(sampler));
  ASSERT_EQ(jobs.size(), 2U);
  EXPECT_THAT(owner->numbers.taken, ElementsAre(1));
}

TEST_F(HandOverTest, WithoutAWorkerTheCallerHandsOut) {
  owner->refuses_jobs = true;
  owner->Ask();
  EXPECT_THAT(owner->numbers.taken, ElementsAre(1, 2));
  owner->refuses_jobs = false;
  owner->Ask();
  EXPECT_EQ(jobs.size(), 1U);
}

TEST_F(HandOverTest, WithoutMemoryForAJobTheCallerHandsOut) {
  owner->has_memory = false;
  owner->Ask();
  EXPECT_THAT(owner->numbers.taken, ElementsAre(1, 2));
  owner->has_memory = true;
  owner->Ask();
  EXPECT_EQ(jobs.size(), 1U);
}

TEST_F(HandOverTest, AFailedJobTellsItsOwner) {
  owner->Ask();
  owner->cancelled = true;
  EXPECT_TRUE(jobs[0]->Cancelled());
  const Error failure(ErrorCode::kInternal, "", "the device is gone");
  jobs[0]->OnDone(&failure);
  EXPECT_THAT(owner->failures, ElementsAre(ErrorCode::kInternal));
  owner->Ask();
  EXPECT_EQ(jobs.size(), 2U);
}

}  // namespace choreo::strand_test
