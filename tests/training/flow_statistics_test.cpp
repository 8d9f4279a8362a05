#include "model/training/flow_matching/flow_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/core/numbers/random.h"
#include "tests/flow/turn_scene.h"

namespace choreo::flow_statistics_test {

using namespace testing_support;

// Measuring dancers who turn according to a prior recovers it.
TEST(FlowStatistics, RecoversTurnStatisticsOfAPrior) {
  const TurnPrior real = GoesOn();
  Random random(2);
  std::vector<WindowRequest> requests;
  for (int i = 0; i < 20'000; ++i) {
    WindowRequest request = To(random.Uniform(-kPi, kPi), random.Uniform(-0.2, 0.2),
                               static_cast<int>(random.Integer(20, 90)));
    request.turn_to_key = real.Sample(Body(), request, random.Normal(), 1);
    requests.push_back(request);
  }
  const TurnPrior measured = MeasureTurns(Body(), requests);
  double squares = 0;
  for (int i = 0; i < 500; ++i) {
    const auto inputs = *TurnPrior::Describe(Body(), requests[static_cast<size_t>(i)]);
    const double off = measured.ChanceOfOther(inputs) - real.ChanceOfOther(inputs);
    squares += off * off / 500;
  }
  EXPECT_LT(std::sqrt(squares), 0.03);
  requests.resize(10);
  EXPECT_FALSE(MeasureTurns(Body(), requests).known()) << "too few";
}

}  // namespace choreo::flow_statistics_test
