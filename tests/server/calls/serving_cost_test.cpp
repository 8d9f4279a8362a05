#include "server/calls/serving_cost.h"

#include <gtest/gtest.h>

namespace choreo::serving_cost_test {

constexpr double kFirst = 1e-4;  // seconds a frame, to begin with

/// A process whose totals the test sets.
class ServingCostTest : public ::testing::Test {
 protected:
  ServingCostTest() { cost.Look(now, true); }

  void Pass(int frames, double cpu_s, double sampling_s = 0, bool dances_alone = true) {
    now.dance_frames += static_cast<uint64_t>(frames);
    now.cpu_s += cpu_s;
    now.sampling_s += sampling_s;
    cost.Look(now, dances_alone);
  }

  ServingCost::Totals now{.cpu_s = 5, .sampling_s = 1, .dance_frames = 100};
  ServingCost cost{kFirst};
};

TEST_F(ServingCostTest, StartsWithWhatItIsGivenOrMeasures) {
  EXPECT_NEAR(cost.seconds_a_frame(), kFirst, 1e-12);
  EXPECT_GT(ServingCost().seconds_a_frame(), 0);
}

TEST_F(ServingCostTest, LearnsWhatTheProcessTakesBesideSampling) {
  for (int look = 0; look < 200; ++look) Pass(300, 300 * 5e-4, 300 * 2e-4);
  EXPECT_NEAR(cost.seconds_a_frame(), 3e-4, 1e-6);
}

TEST_F(ServingCostTest, LearnsNothingOfOtherWork) {
  Pass(0, 10);
  Pass(3, 10, 0, false);
  EXPECT_NEAR(cost.seconds_a_frame(), kFirst, 1e-12);
  Pass(0, 0);
  Pass(300, 300 * kFirst);
  EXPECT_NEAR(cost.seconds_a_frame(), kFirst, 1e-9);
}

// Decoding a file takes as long as thousands of frames.
TEST_F(ServingCostTest, OneDearFrameWeighsAsOneOfMany) {
  Pass(1, 1);
  EXPECT_LT(cost.seconds_a_frame(), 1e-3);
}

TEST_F(ServingCostTest, IsNeverNegative) {
  Pass(300, 0, 10);
  EXPECT_EQ(cost.seconds_a_frame(), 0);
}

}  // namespace choreo::serving_cost_test
