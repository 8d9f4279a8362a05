#include "model/audio/onset.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "model/audio/mel.h"

namespace choreo {
namespace {

/// The rise from frame f - 1 to f is stored this many frames after f: a window reports an attack
/// while its centre is still half a window away.
constexpr Eigen::Index kShift = kFftSize / (2 * kOnsetHop);

double Aggregate(std::array<double, kMelBands>& rises, OnsetAggregate aggregate) {
  if (aggregate == OnsetAggregate::kMean) {
    return std::accumulate(rises.begin(), rises.end(), 0.0) / kMelBands;
  }
  static_assert(kMelBands % 2 == 0);
  const auto middle = rises.begin() + kMelBands / 2;
  std::nth_element(rises.begin(), middle, rises.end());
  return 0.5 * (*std::max_element(rises.begin(), middle) + *middle);
}

}  // namespace

std::vector<float> OnsetStrength(std::span<const float> mono, OnsetAggregate aggregate) {
  const MelSpectrogram db = MelSpectrogramDb(mono, kOnsetHop, 80.0);
  std::vector<float> strength(static_cast<size_t>(db.rows()), 0.0f);
  std::array<double, kMelBands> rises{};
  for (Eigen::Index f = 1; f + kShift < db.rows(); ++f) {
    for (int b = 0; b < kMelBands; ++b) {
      rises[static_cast<size_t>(b)] = std::max(0.0, db(f, b) - db(f - 1, b));
    }
    strength[static_cast<size_t>(f + kShift)] = static_cast<float>(Aggregate(rises, aggregate));
  }
  return strength;
}

}  // namespace choreo
