#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "model/engine/sampling_cost.h"
#include "tests/support/fake_sampler.h"

namespace choreo::warm_up_test {

TEST(WarmUp, MeasuresFrameTime) {
  class SlowSampler final : public FakeSampler {
   public:
    void OnFrame(const TransitionSpec& /*spec*/, Plan* /*plan*/) override {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  SlowSampler sampler;
  EXPECT_EQ(sampler.seconds_a_frame(), 0);
  WarmUp(sampler);
  EXPECT_GE(sampler.seconds_a_frame(), 1e-3);
}

// With beats transitions of `default` take twice as long, and most have them.
TEST(WarmUp, IncludesTheCostOfBeats) {
  class GuidedSampler final : public FakeSampler {
   public:
    void OnFrame(const TransitionSpec& spec, Plan* /*plan*/) override {
      ++(spec.beats.empty() ? unguided : guided);
    }
    int unguided = 0, guided = 0;
  };
  GuidedSampler sampler;
  WarmUp(sampler);
  EXPECT_EQ(sampler.unguided, 0);
  EXPECT_GT(sampler.guided, 0);
}

TEST(SamplingCost, FollowsTheMachine) {
  SamplingCost cost(1e-3);
  EXPECT_NEAR(cost.LoadOf(30), 30e-3, 1e-9);
  EXPECT_NEAR(cost.LoadOf(240), 240e-3, 1e-9);
  for (int i = 0; i < 200; ++i) cost.Add(60 * 2e-3, 60);
  EXPECT_NEAR(cost.LoadOf(30), 60e-3, 1e-5);
}

TEST(SamplingCost, IsUnknownWithoutMeasurements) {
  SamplingCost cost(0);
  cost.Add(1, 60);
  EXPECT_EQ(cost.LoadOf(30), 0);
}

}  // namespace choreo::warm_up_test
