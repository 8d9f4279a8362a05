#include "model/plan/plan_options.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/expect_error.h"

namespace choreo::plan_options_test {

TEST(PlanOptions, MissingOptionsHaveDefaults) {
  nlohmann::json stored = PlanOptions{.accent = 0.1, .hinge_softness = 0.2};
  stored.erase("hinge_softness");
  const auto read = stored.get<PlanOptions>();
  EXPECT_EQ(read.accent, 0.1);
  EXPECT_EQ(read.hinge_softness, PlanOptions{}.hinge_softness);
}

TEST(PlanOptions, TimeNeverRunsBackwards) {
  PlanOptions options{.accent = 1};
  ExpectError(ErrorCode::kInvalidArgument, "config.plan.accent",
              [&] { options.Check("config.plan"); });
  options.accent = 0.99;
  EXPECT_NO_THROW(options.Check("config.plan"));
}

}  // namespace choreo::plan_options_test
