#include "model/audio/signal/fourier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "model/core/numbers/random.h"

namespace choreo::fourier_test {

std::vector<double> Noise(size_t size) {
  Random random(size);
  std::vector<double> samples(size);
  for (double& sample : samples) sample = random.Normal();
  return samples;
}

TEST(FourierPowerTest, AgreesWithTheDefinition) {
  const std::vector<double> samples = Noise(32);
  FourierPower fourier(32);
  const auto powers = fourier.Of(samples);
  ASSERT_EQ(powers.size(), 17u);
  for (size_t k = 0; k < powers.size(); ++k) {
    std::complex<double> sum = 0;
    for (size_t i = 0; i < 32; ++i) {
      sum += samples[i] * std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k * i) / 32);
    }
    EXPECT_NEAR(powers[k], std::norm(sum), 1e-12);
  }
}

// Eigen's is kissfft. Features were made with it.
TEST(FourierPowerTest, HasTheBitsOfKissfft) {
  Eigen::FFT<double> kissfft;
  kissfft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  for (const size_t size : {32, 64, 1024, 2048, 4096}) {
    const std::vector<double> samples = Noise(size);
    std::vector<std::complex<double>> bins;
    kissfft.fwd(bins, samples);
    FourierPower fourier(size);
    const auto powers = fourier.Of(samples);
    ASSERT_EQ(powers.size(), bins.size());
    for (size_t k = 0; k < bins.size(); ++k) EXPECT_EQ(powers[k], std::norm(bins[k])) << size;
  }
}

}  // namespace choreo::fourier_test
