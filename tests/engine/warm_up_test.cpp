#include "model/engine/warm_up.h"

#include <gtest/gtest.h>

#include "tests/support/fake_engine.h"

namespace choreo {
namespace {

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

}  // namespace
}  // namespace choreo
