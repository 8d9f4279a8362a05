#pragma once

#include <array>
#include <cstddef>

#include "model/audio/mel.h"

namespace choreo {

/// How strongly something begins, row by row of a FeatureStream: by how many dB its mel bands rose
/// within two rows, 67 ms, the mean of all bands and of the bass. What lies more than 40 dB below
/// the loudest band of the last two seconds is not heard. A row's value is known with the row, and
/// depends on no more than the kMemory rows before it. The live pulse is heard in this. Not
/// thread-safe.
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
