#include "model/core/running/slices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace choreo::slices_test {

using ::testing::ElementsAre;

using Log = std::vector<std::string>;

Slices<int> Count(int slices, Log* log) {
  for (int i = 1; i < slices; ++i) {
    log->push_back(std::to_string(i));
    co_await Pause();
  }
  co_return slices;
}

Slices<std::string> Nested(int first, int second, Log* log) {
  const int one = co_await Count(first, log);
  log->push_back("between");
  const int other = co_await Count(second, log);
  co_return std::to_string(one + other);
}

TEST(Slices, PauseWhereTheInnermostPauses) {
  Log log;
  Slices<std::string> work = Nested(3, 2, &log);
  EXPECT_TRUE(log.empty()) << "nothing runs before the first slice";
  EXPECT_TRUE(work.Continue());
  EXPECT_THAT(log, ElementsAre("1"));
  EXPECT_TRUE(work.Continue());
  EXPECT_TRUE(work.Continue());
  EXPECT_THAT(log, ElementsAre("1", "2", "between", "1"));
  EXPECT_FALSE(work.Continue());
  EXPECT_EQ(work.Take(), "5");
}

TEST(Slices, TakeTurns) {
  Log log;
  Slices<int> one = Count(3, &log);
  Slices<std::string> other = Nested(2, 2, &log);
  while (one.Continue()) EXPECT_TRUE(other.Continue());
  EXPECT_EQ(one.Take(), 3);
  EXPECT_EQ(other.Finish(), "4");
}

Slices<> Fail(Log* log) {
  co_await Count(2, log);
  throw std::runtime_error("failed");
}

Slices<> Guarded(Log* log) {
  try {
    co_await Fail(log);
  } catch (const std::runtime_error& error) {
    log->emplace_back(error.what());
  }
  co_await Fail(log);
}

TEST(Slices, PassExceptionsToTheAwaiter) {
  Log log;
  EXPECT_THROW(Guarded(&log).Finish(), std::runtime_error);
  EXPECT_THAT(log, ElementsAre("1", "failed", "1"));
}

Slices<> Hold(std::shared_ptr<int> held, Log* log) {
  co_await Count(9, log);
  *held = 1;
}

TEST(Slices, FreeWhatTheyHoldWhenDropped) {
  Log log;
  const auto held = std::make_shared<int>();
  {
    Slices<> work = Hold(held, &log);
    EXPECT_TRUE(work.Continue());
    EXPECT_GT(held.use_count(), 1);
  }
  EXPECT_EQ(held.use_count(), 1);
  EXPECT_EQ(*held, 0);
}

}  // namespace choreo::slices_test
