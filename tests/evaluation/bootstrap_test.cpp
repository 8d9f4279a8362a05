#include "model/metrics/bootstrap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/evaluation/table.h"

namespace choreo::bootstrap_test {

TEST(Bootstrap, EqualClipsHaveAnEmptyInterval) {
  const std::vector<double> above = {1, 2, 3}, below = {2, 4, 6};
  const auto interval = BootstrapRatio(above, below);
  ASSERT_TRUE(interval);
  EXPECT_DOUBLE_EQ(interval->low, 0.5);
  EXPECT_DOUBLE_EQ(interval->high, 0.5);
}

TEST(Bootstrap, TheIntervalOfAMeanIsNearTheNormalOne) {
  // 0 and 1, fifty each: the mean's standard error is 0.05.
  std::vector<double> values(100), counts(100, 1.0);
  for (size_t i = 0; i < 50; ++i) values[i] = 1;
  const auto interval = BootstrapRatio(values, counts);
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->low, 0.5 - 1.96 * 0.05, 0.015);
  EXPECT_NEAR(interval->high, 0.5 + 1.96 * 0.05, 0.015);
  const auto again = BootstrapRatio(values, counts);
  EXPECT_EQ(interval->low, again->low);
  EXPECT_EQ(interval->high, again->high);
}

TEST(Bootstrap, OneClipHasNoInterval) {
  const std::vector<double> one = {1};
  EXPECT_FALSE(BootstrapRatio(one, one));
}

TEST(Bootstrap, GroupsWeighAlikeInAMeanOfMeans) {
  // Means 2 and 10, of four windows and of one.
  const std::vector<ClipFigure> many = {{0, 1}, {0, 3}, {1, 1}, {1, 3}}, one = {{1, 10}};
  const Cell cell = MeanOfMeans({many, one});
  EXPECT_DOUBLE_EQ(cell.value, 6);
  ASSERT_TRUE(cell.interval);
  EXPECT_DOUBLE_EQ(cell.interval->low, 2);  // the first clip alone
  EXPECT_TRUE(std::isnan(MeanOfMeans({}).value));
}

TEST(Bootstrap, RatioOverZeroIsNone) {
  EXPECT_DOUBLE_EQ(Ratio({{0, 1}, {1, 2}}, {{0, 2}, {1, 4}}).value, 0.5);
  EXPECT_TRUE(std::isnan(Ratio({}, {{0, 1}}).value));
  EXPECT_TRUE(std::isnan(Ratio({{0, 1}}, {}).value));
}

}  // namespace choreo::bootstrap_test
