#include "model/engine/engine_cost.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/support/fake_engine.h"

namespace choreo::warm_up_test {

class CountingEngine final : public FakeEngine {
 public:
  using FakeEngine::FakeEngine;
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override {
    FakeEngine::Step(in, out);
    ++steps;
  }
  int steps = 0;
};

TEST(WarmUp, DancesAndLeavesNothingBehind) {
  CountingEngine engine(2);
  WarmUp(engine);
  EXPECT_GT(engine.steps, 0);
  EXPECT_EQ(engine.free_slots(), 2);
}

TEST(WarmUp, MeasuresAStepAloneAndTogether) {
  class SlowEngine final : public FakeEngine {
   public:
    using FakeEngine::FakeEngine;
    int BeginAdmission(const TransitionSpec& spec) override {
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
      return FakeEngine::BeginAdmission(spec);
    }
    void Step(std::span<const StepInput> in, std::span<StepOutput> out) override {
      std::this_thread::sleep_for(std::chrono::milliseconds(in.size()));
      FakeEngine::Step(in, out);
    }
  };
  SlowEngine engine(4);
  WarmUp(engine);
  EXPECT_GE(engine.cost().admission, 1e-3);  // of 60 frames
  EXPECT_GE(engine.cost().alone, 1e-3);
  EXPECT_GE(engine.cost().together, 4e-3);
  EXPECT_EQ(engine.cost().slots, 4);
}

// With beats transitions of `default` take twice as long, and most have them.
TEST(WarmUp, CountsWhatBeatsCost) {
  class GuidedEngine final : public FakeEngine {
   public:
    using FakeEngine::FakeEngine;
    int BeginAdmission(const TransitionSpec& spec) override {
      if (spec.beats.empty()) ++unguided;
      return FakeEngine::BeginAdmission(spec);
    }
    int unguided = 0;
  };
  GuidedEngine engine(2);
  WarmUp(engine);
  EXPECT_EQ(engine.unguided, 0);
}

TEST(FrameCost, FollowsTheMachine) {
  FrameCost cost({.admission = 0, .alone = 1e-3, .together = 1e-3, .slots = 4}, 4);
  EXPECT_NEAR(cost.LoadOf(30, 30), 30e-3, 1e-9);
  EXPECT_NEAR(cost.LoadOf(120, 30), 30e-3, 1e-9);  // four in one step
  EXPECT_NEAR(cost.LoadOf(240, 30), 60e-3, 1e-9);  // and no more
  for (int i = 0; i < 1'000; ++i) cost.AddStep(3, 2e-3);
  EXPECT_NEAR(cost.LoadOf(30, 30), 60e-3, 1e-5);
  for (int i = 0; i < 200; ++i) cost.AddTransition(1e-3, 10);
  EXPECT_NEAR(cost.LoadOf(30, 30), 60e-3 + 3e-3, 1e-5);
}

// Who begins transitions and never dances them makes frames dear, not without price.
TEST(FrameCost, TransitionsWithoutAFrameCountAsOne) {
  FrameCost cost({.admission = 1e-3, .alone = 1e-3, .together = 1e-3, .slots = 1}, 1);
  for (int i = 0; i < 1'000; ++i) cost.AddTransition(1e-3, 0);
  EXPECT_NEAR(cost.LoadOf(1, 30), 2e-3, 1e-6);
}

}  // namespace choreo::warm_up_test
