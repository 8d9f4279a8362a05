#pragma once

#include <array>
#include <cstddef>

#include "model/audio/signal/mel.h"

namespace choreo {

/// Measures onsets row by row of a FeatureStream: the rise in dB of its mel bands over two rows (67
/// ms), averaged over all bands and over the bass. Ignores levels more than 40 dB below the loudest
/// band of the last two seconds. A row's value needs no later rows, and depends on at most the
/// kMemory rows before it. Not thread-safe.
class RowOnset {
 public:
  static constexpr size_t kRiseRows = 2, kLoudRows = 60;
  static constexpr int kMemory = kRiseRows + kLoudRows;

  /// `db`: the bands of the next row.
  float Add(const MelBandsDb& db);

 private:
  size_t rows_ = 0;
  std::array<MelBandsDb, kRiseRows> before_{};
  std::array<double, kLoudRows> loudest_{};
};

}  // namespace choreo
