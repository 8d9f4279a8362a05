#include "model/audio/signal/mfcc.h"

#include <cmath>
#include <iterator>
#include <numbers>

namespace choreo {
namespace {

using DctTable = Eigen::Matrix<double, kMfccCount, kMelBands, Eigen::RowMajor>;

const DctTable& Dct() {
  static const DctTable table = DctTable::NullaryExpr([](Eigen::Index k, Eigen::Index n) {
    const double scale = std::sqrt((k == 0 ? 1.0 : 2.0) / kMelBands);
    return scale * std::cos(std::numbers::pi * static_cast<double>(k) *
                            static_cast<double>(2 * n + 1) / (2.0 * kMelBands));
  });
  return table;
}

}  // namespace

void MfccOfMelDb(std::span<const double, kMelBands> db, std::span<float, kMfccCount> row) {
  const DctTable& dct = Dct();
  for (size_t k = 0; k < row.size(); ++k) {
    double sum = 0;
    for (size_t n = 0; n < db.size(); ++n) sum += dct(k, n) * db[n];
    row[k] = static_cast<float>(sum);
  }
}

FeatureMatrix Mfcc(std::span<const float> mono) {
  const std::vector<MelBandsDb> frames = MelSpectrogram(mono, kFeatureHop);
  FeatureMatrix rows(std::ssize(frames), kMfccCount);
  float* row = rows.data();
  for (const MelBandsDb& db : frames) {
    MfccOfMelDb(db, std::span<float, kMfccCount>(row, kMfccCount));
    row += kMfccCount;
  }
  return rows;
}

}  // namespace choreo
