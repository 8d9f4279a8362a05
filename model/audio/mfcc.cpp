#include "model/audio/mfcc.h"

#include <array>
#include <cmath>
#include <numbers>

namespace choreo {
namespace {

using DctTable = std::array<std::array<double, kMelBands>, kMfccCount>;

const DctTable& Dct() {
  static const DctTable table = [] {
    DctTable cosines{};
    for (int k = 0; k < kMfccCount; ++k) {
      const double scale = std::sqrt((k == 0 ? 1.0 : 2.0) / kMelBands);
      for (int n = 0; n < kMelBands; ++n) {
        cosines[static_cast<size_t>(k)][static_cast<size_t>(n)] =
            scale * std::cos(std::numbers::pi * k * (2 * n + 1) / (2.0 * kMelBands));
      }
    }
    return cosines;
  }();
  return table;
}

}  // namespace

void MfccOfMelDb(std::span<const double, kMelBands> db, std::span<float, kMfccCount> row) {
  const DctTable& dct = Dct();
  for (size_t k = 0; k < row.size(); ++k) {
    double sum = 0;
    for (size_t n = 0; n < db.size(); ++n) sum += dct[k][n] * db[n];
    row[k] = static_cast<float>(sum);
  }
}

FeatureMatrix Mfcc(std::span<const float> mono) {
  const MelSpectrogram db = MelSpectrogramDb(mono, kFeatureHop);
  FeatureMatrix rows(db.rows(), kMfccCount);
  for (Eigen::Index r = 0; r < db.rows(); ++r) {
    MfccOfMelDb(std::span<const double, kMelBands>(db.row(r).data(), kMelBands),
                std::span<float, kMfccCount>(rows.row(r).data(), kMfccCount));
  }
  return rows;
}

}  // namespace choreo
