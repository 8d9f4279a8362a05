#include "model/audio/onset.h"

#include <algorithm>

#include "model/audio/format.h"

namespace choreo {
namespace {

constexpr double kRangeDb = 40;  // what lies further below the loudest band is not heard
// Up to 130 Hz, where the low drum is. It says which of two pulses half a beat apart is the beat,
// so these few bands weigh as much as all.
constexpr size_t kBassBands = 4;

// A window reports an attack while its centre is still before it: by about so many frames.
constexpr size_t kShift = 1;

/// The frames of OnsetStrength.
using FrameOnset = OnsetMeter<1, 2 * kModelSampleRate / kOnsetHop>;

}  // namespace

template <size_t kRiseRows, size_t kLoudRows>
float OnsetMeter<kRiseRows, kLoudRows>::Add(std::span<const double, kMelBands> db) {
  loudest_[rows_ % kLoudRows] = *std::max_element(db.begin(), db.end());
  const auto known = static_cast<std::ptrdiff_t>(std::min(rows_ + 1, kLoudRows));
  const double floor = *std::max_element(loudest_.begin(), loudest_.begin() + known) - kRangeDb;
  double all = 0, bass = 0;
  auto& before = before_[rows_ % kRiseRows];
  for (size_t band = 0; band < kMelBands; ++band) {
    const double rise =
        rows_ < kRiseRows ? 0 : std::max(0.0, db[band] - std::max(before[band], floor));
    all += rise;
    if (band < kBassBands) bass += rise;
    before[band] = db[band];
  }
  ++rows_;
  return static_cast<float>(0.5 * (all / kMelBands + bass / kBassBands));
}

template class OnsetMeter<2, 60>;

std::vector<float> OnsetStrength(std::span<const float> mono) {
  const MelSpectrogram db = MelSpectrogramDb(mono, kOnsetHop);
  const auto frames = static_cast<size_t>(db.rows());
  std::vector<float> strength(frames, 0.0f);
  FrameOnset onset;
  for (size_t f = 0; f + kShift < frames; ++f) {
    strength[f + kShift] = onset.Add(
        std::span<const double, kMelBands>(db.row(static_cast<Eigen::Index>(f)).data(), kMelBands));
  }
  return strength;
}

}  // namespace choreo
