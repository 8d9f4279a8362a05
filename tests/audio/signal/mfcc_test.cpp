#include "model/audio/signal/mfcc.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/audio/signals.h"

namespace choreo::mfcc_test {

TEST(MfccTest, TheTransformIsOrthonormal) {
  Eigen::MatrixXd transform(kMfccCount, kMelBands);
  std::array<double, kMelBands> unit{};
  std::array<float, kMfccCount> row{};
  for (int n = 0; n < kMelBands; ++n) {
    unit.fill(0);
    unit[static_cast<size_t>(n)] = 1;
    MfccOfMelDb(unit, row);
    for (int k = 0; k < kMfccCount; ++k) transform(k, n) = row[static_cast<size_t>(k)];
  }
  const Eigen::MatrixXd gram = transform * transform.transpose();
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(kMfccCount, kMfccCount)).cwiseAbs().maxCoeff(), 1e-6);
  // Coefficient k of the bands cos(pi k (2 n + 1) / 256) is sqrt(64); the sign and the phase are
  // those of type II.
  std::array<double, kMelBands> wave{};
  for (size_t n = 0; n < wave.size(); ++n) {
    wave[n] = std::cos(std::numbers::pi * 3 * (2.0 * static_cast<double>(n) + 1) / 256);
  }
  MfccOfMelDb(wave, row);
  for (size_t k = 0; k < row.size(); ++k) EXPECT_NEAR(row[k], k == 3 ? 8.0 : 0.0, 1e-6);
}

TEST(MfccTest, SilenceHasOneCoefficient) {
  const FeatureMatrix rows = Mfcc(std::vector<float>(3000, 0.0f));
  EXPECT_EQ(rows.rows(), 5);
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    EXPECT_NEAR(rows(r, 0), -100 * std::sqrt(128.0), 1e-3);
    EXPECT_LT(rows.row(r).tail(kMfccCount - 1).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(MfccTest, LoudnessMovesTheFirstCoefficientOnly) {
  std::vector<float> wave = Noise(6000, 9, 0.5);
  const FeatureMatrix loud = Mfcc(wave);
  for (float& sample : wave) sample *= 0.5f;
  const FeatureMatrix soft = Mfcc(wave);
  const FeatureMatrix difference = loud - soft;
  const double drop = 20 * std::log10(2.0) * std::sqrt(128.0);
  EXPECT_NEAR(difference.col(0).minCoeff(), drop, 1e-3);
  EXPECT_NEAR(difference.col(0).maxCoeff(), drop, 1e-3);
  EXPECT_LT(difference.rightCols(kMfccCount - 1).cwiseAbs().maxCoeff(), 1e-3);
}

void ExpectStart(const FeatureMatrix& rows, int row, const std::vector<double>& expected) {
  for (size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(rows(row, static_cast<Eigen::Index>(k)), expected[k], 0.01) << row << ", " << k;
  }
}

// Computed with NumPy from the definitions.
TEST(MfccTest, AgreesWithAnIndependentComputation) {
  const FeatureMatrix rows = Mfcc(TonesAndBursts());
  ASSERT_EQ(rows.rows(), 46);
  ExpectStart(rows, 0,
              {-141.4845, 92.1078, 25.7791, 114.4474, 14.0162, -51.9438, -19.2836, -10.1303});
  ExpectStart(rows, 10,
              {-782.9593, 254.5270, -68.6336, -94.5719, -8.6502, 54.3878, 60.0328, -96.8743});
  ExpectStart(rows, 44,
              {-364.5138, 85.2867, 101.5038, 67.3574, -81.4707, 8.1781, -8.3590, -35.3974});
  EXPECT_NEAR(rows(10, 37), -25.5667, 0.01);
  EXPECT_NEAR(rows(44, 39), -9.9642, 0.01);
}

TEST(MfccTest, RowsAreCountedByTheHop) {
  for (const int samples : {1, 734, 735, 736, 22050}) {
    const std::vector<float> wave(static_cast<size_t>(samples), 0.1f);
    EXPECT_EQ(Mfcc(wave).rows(), 1 + samples / 735);
  }
}

}  // namespace choreo::mfcc_test
