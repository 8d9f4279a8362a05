#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "model/audio/mel.h"

namespace choreo {

/// How strongly something begins, row by row of mel bands: by how many dB they rose within
/// `kRiseRows`, the mean of all bands and of the bass. What lies more than 40 dB below the loudest
/// band of the last `kLoudRows` rows is not heard. A row's value is known with the row, and depends
/// on no more than the kMemory rows before it. Beats are heard in this, live and in whole songs.
/// Not thread-safe.
template <size_t kRiseRows, size_t kLoudRows>
class OnsetMeter {
 public:
  static constexpr int kMemory = kRiseRows + kLoudRows;

  /// `db`: the bands of the next row.
  float Add(const MelBandsDb& db);

 private:
  size_t rows_ = 0;
  std::array<MelBandsDb, kRiseRows> before_{};
  std::array<double, kLoudRows> loudest_{};
};

/// Of the rows of a FeatureStream: over two rows, 67 ms, and two seconds.
inline constexpr size_t kRowRise = 2, kRowLoud = 60;
using RowOnset = OnsetMeter<kRowRise, kRowLoud>;

/// Samples at 22 050 Hz from one onset value, and one beat frame, to the next.
inline constexpr int kOnsetHop = 512;

/// Onset strength of mono samples at 22 050 Hz, all of them: rises over one frame, 23 ms. Value f
/// describes sample f * kOnsetHop; there are 1 + samples / kOnsetHop, all >= 0, the first one 0.
/// Errors as MelSpectrogram.
std::vector<float> OnsetStrength(std::span<const float> mono);

}  // namespace choreo
