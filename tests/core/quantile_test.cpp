#include "model/core/numbers/quantile.h"

#include <gmock/gmock.h>

namespace choreo::quantile_test {

TEST(Quantile, IsAValueOfItsRank) {
  const std::vector<double> values = {5, 1, 4, 2, 3};
  EXPECT_EQ(Quantile(values, 0), 1);
  EXPECT_EQ(Quantile(values, 0.5), 3);
  EXPECT_EQ(Quantile(values, 0.9), 4);
  EXPECT_EQ(Quantile(values, 1), 5);
  EXPECT_EQ(Median(std::vector{1.0F, 4.0F, 2.0F, 3.0F}), 3);
}

TEST(Quantile, OfASlowSignalIgnoresSpikes) {
  std::vector<double> values(50, 2);
  values[20] = 100;
  EXPECT_THAT(SlowQuantile(values, 0.5, 10), testing::Each(2));
  EXPECT_THAT(SlowQuantile({7}, 0.1, 10), testing::ElementsAre(7));
  // A line has the mean of its own neighbours in its middle.
  for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
  EXPECT_DOUBLE_EQ(SlowQuantile(values, 0.5, 10)[25], 25);
}

}  // namespace choreo::quantile_test
