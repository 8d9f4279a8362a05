#include "model/audio/music/row_onset.h"

#include <algorithm>

namespace choreo {
namespace {

constexpr double kHeardDb = 40;  // sound this far below the loudest band is ignored

}  // namespace

float RowOnset::Add(const MelBandsDb& db) {
  loudest_[rows_ % kLoudRows] = *std::ranges::max_element(db);
  const auto known = static_cast<std::ptrdiff_t>(std::min(rows_ + 1, kLoudRows));
  const double floor = *std::max_element(loudest_.begin(), loudest_.begin() + known) - kHeardDb;
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
  // The bass drum decides which of two pulses half a beat apart is the beat, so its few bands weigh
  // as much as all.
  return static_cast<float>(0.5 * (all / kMelBands + bass / kBassBands));
}

}  // namespace choreo
