#include "model/audio/onset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "model/core/error.h"
#include "tests/audio/signals.h"

namespace choreo::onset_test {

TEST(OnsetTest, PeaksWhereTheSoundBegins) {
  for (const int64_t start : {5120, 10000, 17777}) {
    std::vector<float> wave(30000, 0.0f);
    const std::vector<float> noise = Noise(30000 - start, 2, 0.5);
    std::copy(noise.begin(), noise.end(), wave.begin() + start);
    const std::vector<float> strength = OnsetStrength(wave);
    ASSERT_EQ(strength.size(), 1u + 30000 / kOnsetHop);
    const auto peak = std::max_element(strength.begin(), strength.end());
    EXPECT_GT(*peak, 20.0f);
    EXPECT_NEAR(static_cast<double>(peak - strength.begin()) * kOnsetHop,
                static_cast<double>(start), kOnsetHop);
  }
}

TEST(OnsetTest, SilenceAndSteadyTonesHaveNone) {
  for (const float value : OnsetStrength(std::vector<float>(20000, 0.0f))) EXPECT_EQ(value, 0.0f);
  const std::vector<float> strength = OnsetStrength(Sine(22050.0 / 512 * 20, 22050, 40000, 0.5));
  for (size_t i = 8; i + 4 < strength.size(); ++i) EXPECT_LT(strength[i], 0.1f) << i;
}

// Computed with NumPy from the definitions.
TEST(OnsetTest, AgreesWithAnIndependentComputation) {
  const std::vector<double> expected = {0,      0,      0.0875, 0.1652, 0.3073, 0.3049, 0.3121,
                                        0.3086, 0.3028, 0.3092, 0.3007, 0.5936, 0.4230, 0.2509,
                                        0.2344, 0.2211, 0.2124, 0.2059, 0.1906, 0.1831, 0.1795,
                                        0.1740, 0.5484, 0.2005, 0.1438, 0.1517, 0.1423, 0.1351};
  const std::vector<float> strength = OnsetStrength(TonesAndBursts());
  ASSERT_EQ(strength.size(), 65u);
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(strength[i], expected[i], 1e-3) << i;
}

TEST(OnsetTest, TheBassWeighsAsMuchAsAllBands) {
  std::array<double, kMelBands> quiet{}, low{}, all{};
  std::fill(low.begin(), low.begin() + 4, 10.0);
  all.fill(10);
  const auto strength = [&](const std::array<double, kMelBands>& then) {
    RowOnset onset;
    onset.Add(quiet);
    onset.Add(quiet);
    return onset.Add(then);
  };
  EXPECT_FLOAT_EQ(strength(all), 10);
  EXPECT_FLOAT_EQ(strength(low), 5 + 5 * 4.0F / kMelBands);
}

TEST(OnsetTest, ShortSoundsHaveZeros) {
  for (const int samples : {1, 511}) {
    const std::vector<float> strength = OnsetStrength(Noise(samples, 3));
    EXPECT_EQ(strength, std::vector<float>(static_cast<size_t>(1 + samples / 512), 0.0f));
  }
  EXPECT_THROW(OnsetStrength({}), Error);
}

}  // namespace choreo::onset_test
