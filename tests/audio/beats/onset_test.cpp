#include "model/audio/beats/onset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "model/audio/music/row_onset.h"
#include "model/core/error.h"
#include "tests/audio/signals.h"

namespace choreo::onset_test {

std::vector<float> Strength(std::span<const float> wave) { return OnsetStrength(FindOnsets(wave)); }

TEST(OnsetTest, PeaksWhereTheSoundBegins) {
  for (const int64_t start : {5120, 10000, 17777}) {
    std::vector<float> wave(30000, 0.0f);
    const std::vector<float> noise = Noise(30000 - start, 2, 0.5);
    std::copy(noise.begin(), noise.end(), wave.begin() + start);
    const std::vector<float> strength = Strength(wave);
    ASSERT_EQ(strength.size(), 1u + 30000 / kOnsetHop);
    const auto peak = std::max_element(strength.begin(), strength.end());
    EXPECT_GT(*peak, 20.0f);
    EXPECT_NEAR(static_cast<double>(peak - strength.begin()) * kOnsetHop,
                static_cast<double>(start), kOnsetWindow / 2.0);
  }
}

TEST(OnsetTest, SilenceAndSteadyTonesHaveNone) {
  for (const float value : Strength(std::vector<float>(20000, 0.0f))) EXPECT_EQ(value, 0.0f);
  const std::vector<float> strength = Strength(Sine(22050.0 / 1024 * 40, 22050, 40000, 0.5));
  for (size_t i = 8; i + 8 < strength.size(); ++i) EXPECT_LT(strength[i], 0.1f) << i;
}

TEST(OnsetTest, BandsAreSeparated) {
  const auto strongest = [](double hz) {
    std::vector<float> wave(20000, 0.0f);
    const std::vector<float> tone = Sine(hz, 22050, 10000, 0.5);
    // Fades in, as a tone that is switched on sounds in all bands.
    for (size_t i = 0; i < tone.size(); ++i)
      wave[10000 + i] = tone[i] * std::min(1.0F, static_cast<float>(i) / 1500);
    Onset sum;
    for (const Onset& onset : FindOnsets(wave)) {
      for (size_t band = 0; band < Onset::kBands; ++band) sum.rise[band] += onset.rise[band];
    }
    return std::max_element(sum.rise.begin(), sum.rise.end()) - sum.rise.begin();
  };
  EXPECT_EQ(strongest(70), 0);
  EXPECT_EQ(strongest(600), 1);
}

TEST(OnsetTest, ADcOffsetChangesNothing) {
  std::vector<float> wave = TonesAndBursts();
  const std::vector<float> plain = Strength(wave);
  for (float& sample : wave) sample += 0.25F;
  const std::vector<float> offset = Strength(wave);
  for (size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(offset[i], plain[i], 0.05) << i;
}

TEST(OnsetTest, LoudnessIsTheLoudestBands) {
  const std::vector<Onset> onsets = FindOnsets(Sine(1000, 22050, 22050, 1.0));
  EXPECT_NEAR(onsets[45].loud_db, 0, 2);
  EXPECT_EQ(FindOnsets(std::vector<float>(5000, 0.0F))[5].loud_db, -100);
}

TEST(OnsetTest, OnsetsDependOnAFiniteMemory) {
  const std::vector<float> wave = Noise(4 * 22050, 7, 0.3);
  const std::vector<Onset> whole = FindOnsets(wave);
  constexpr size_t kFrom = 60;  // frames ignored
  const std::vector<Onset> later = FindOnsets(std::span(wave).subspan(kFrom * kOnsetHop));
  for (size_t f = OnsetMeter::kMemory + 3; f < later.size(); ++f)
    EXPECT_EQ(later[f], whole[f + kFrom]) << f;
}

TEST(OnsetTest, TheBassWeighsAsMuchAsAllBandsInRows) {
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
  for (const int samples : {1, 244}) {
    const std::vector<float> strength = Strength(Noise(samples, 3));
    EXPECT_EQ(strength, std::vector<float>(1, 0.0f));
  }
  EXPECT_THROW(FindOnsets({}), Error);
}

}  // namespace choreo::onset_test
