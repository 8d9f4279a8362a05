#include "model/audio/signal/mel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "model/core/error.h"
#include "tests/audio/signals.h"

namespace choreo::mel_test {

/// Edges and centres of the bands on Slaney's scale: mel m of 0 to 15 is 200 m / 3 Hz, above it
/// 1000 * 6.4^((m - 15) / 27) Hz.
double CornerHz(int corner) {
  const double top = 15 + 27 * std::log(11.025) / std::log(6.4);
  const double mel = top * corner / 129;
  return mel < 15 ? mel * 200 / 3 : 1000 * std::pow(6.4, (mel - 15) / 27);
}

std::vector<double> PowerOfSine(double hz, double amplitude) {
  MelSpectrum spectrum;
  std::vector<double> power;
  for (const double db : spectrum.Decibels(Sine(hz, 22050, kFftSize, amplitude)))
    power.push_back(std::pow(10, db / 10));
  return power;
}

TEST(MelSpectrumTest, ASinePeaksInTheBandAroundItsFrequency) {
  for (const int band : {5, 20, 40, 64, 100, 126}) {
    const std::vector<double> power = PowerOfSine(CornerHz(band + 1), 0.5);
    const auto peak = std::max_element(power.begin(), power.end());
    // Low bands are narrower than the window's resolution: the neighbour may win there.
    EXPECT_NEAR(static_cast<double>(peak - power.begin()), band, band < 30 ? 1 : 0);
  }
}

// Bands times half their width are a partition of unity between the first centre and the last, and
// a sine in the middle of a bin has under a Hann window the squared magnitudes (A N / 4)^2 (1/4, 1,
// 1/4).
TEST(MelSpectrumTest, BandsShareOutAllOfTheirPower) {
  for (const int bin : {30, 100, 333, 800}) {
    const std::vector<double> power = PowerOfSine(bin * 22050.0 / kFftSize, 0.5);
    double total = 0;
    for (int b = 0; b < kMelBands; ++b) {
      total += power[static_cast<size_t>(b)] * (CornerHz(b + 2) - CornerHz(b)) / 2;
    }
    EXPECT_NEAR(total / (1.5 * std::pow(0.5 * kFftSize / 4, 2)), 1, 1e-6) << bin;
  }
}

TEST(MelSpectrumTest, SilenceIsTheFloor) {
  const std::vector<MelBandsDb> frames = MelSpectrogram(std::vector<float>(5000, 0.0f), 735);
  EXPECT_EQ(frames.size(), 1u + 5000 / 735);
  for (const MelBandsDb& db : frames) EXPECT_THAT(db, ::testing::Each(-100.0));
}

TEST(MelSpectrumTest, FramesAreCentred) {
  // One click at sample 5120: loudest in frame 10, equal in frames at equal distance.
  std::vector<float> wave(12000, 0.0f);
  wave[5120] = 1.0f;
  const std::vector<MelBandsDb> db = MelSpectrogram(wave, 512);
  const auto loudness = [](const MelBandsDb& frame) {
    return std::accumulate(frame.begin(), frame.end(), 0.0);
  };
  EXPECT_EQ(std::ranges::max_element(db, {}, loudness) - db.begin(), 10);
  EXPECT_NEAR(db[9][60], db[11][60], 1e-6);
  EXPECT_EQ(db[8][60], -100.0);  // the periodic window is 0 at its first sample
  EXPECT_EQ(db[12][60], -100.0);
}

TEST(MelSpectrumTest, RefusesInvalidSizes) { EXPECT_THROW(MelSpectrogram({}, 512), Error); }

}  // namespace choreo::mel_test
