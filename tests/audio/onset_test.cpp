#include "model/audio/onset.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/core/error.h"
#include "tests/audio/signals.h"

namespace choreo {
namespace {

TEST(OnsetTest, PeaksWhereTheSoundBegins) {
  for (const int64_t start : {5120, 10000, 17777}) {
    std::vector<float> wave(30000, 0.0f);
    const std::vector<float> noise = Noise(30000 - start, 2, 0.5);
    std::copy(noise.begin(), noise.end(), wave.begin() + start);
    for (const auto aggregate : {OnsetAggregate::kMean, OnsetAggregate::kMedian}) {
      const std::vector<float> strength = OnsetStrength(wave, aggregate);
      ASSERT_EQ(strength.size(), 1u + 30000 / kOnsetHop);
      const auto peak = std::max_element(strength.begin(), strength.end());
      EXPECT_GT(*peak, 20.0f);
      EXPECT_NEAR(static_cast<double>(peak - strength.begin()) * kOnsetHop,
                  static_cast<double>(start), kOnsetHop);
    }
  }
}

TEST(OnsetTest, SilenceAndSteadyTonesHaveNone) {
  for (const float value : OnsetStrength(std::vector<float>(20000, 0.0f))) EXPECT_EQ(value, 0.0f);
  const std::vector<float> strength = OnsetStrength(Sine(22050.0 / 512 * 20, 22050, 40000, 0.5));
  for (size_t i = 8; i + 4 < strength.size(); ++i) EXPECT_LT(strength[i], 0.1f) << i;
}

// Computed with NumPy from the definitions.
TEST(OnsetTest, AgreesWithAnIndependentComputation) {
  const std::vector<double> mean = {0,      0,       0,       0.1749, 0.3305, 1.4523,  1.4603,
                                    1.5845, 1.4690,  1.4533,  1.4263, 4.8608, 19.1309, 3.2888,
                                    0.6101, 0.7100,  1.0231,  0.9765, 0.9237, 0.8909,  0.8516,
                                    0.8204, 12.0132, 15.0302, 0.7555, 0.3440, 0.4517,  0.6599};
  const std::vector<double> median = {0, 0,      0,       0,       0,      0, 0, 0, 0, 0,
                                      0, 1.4301, 25.9171, 3.0664,  0,      0, 0, 0, 0, 0,
                                      0, 0,      12.8872, 16.2525, 0.3756, 0, 0, 0};
  const std::vector<float> strength = OnsetStrength(TonesAndBursts());
  const std::vector<float> middle = OnsetStrength(TonesAndBursts(), OnsetAggregate::kMedian);
  ASSERT_EQ(strength.size(), 65u);
  ASSERT_EQ(middle.size(), 65u);
  for (size_t i = 0; i < mean.size(); ++i) {
    EXPECT_NEAR(strength[i], mean[i], 1e-3) << i;
    EXPECT_NEAR(middle[i], median[i], 1e-3) << i;
  }
}

TEST(OnsetTest, ShortSoundsHaveZeros) {
  for (const int samples : {1, 512, 1024, 1535}) {
    const std::vector<float> strength = OnsetStrength(Noise(samples, 3));
    EXPECT_EQ(strength, std::vector<float>(static_cast<size_t>(1 + samples / 512), 0.0f));
  }
  EXPECT_THROW(OnsetStrength({}), Error);
}

}  // namespace
}  // namespace choreo
