#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/mel.h"

/// Beats heard while the music plays: what will come, told from what came. Everything here counts
/// in the rows of a FeatureStream, 30 a second.
namespace choreo {

/// Onset strength row by row: by how many dB the mel bands rose within two rows, the mean of all
/// bands and of the bass. What lies more than 40 dB below the loudest band of the last two seconds
/// is not heard. Row r's value
/// is known with row r. It looks back kOnsetMemory rows and no further. Not thread-safe.
class RowOnset {
 public:
  static constexpr int kOnsetMemory = 62;  ///< rows before a row that its value depends on

  /// `db`: the bands of the next row.
  float Add(std::span<const double, kMelBands> db);

 private:
  static constexpr size_t kBack = 2;       // rows that a rise takes
  static constexpr size_t kLoudness = 60;  // rows over which the loudest band is looked for

  int64_t rows_ = 0;
  std::array<std::array<double, kMelBands>, kBack> before_{};
  std::array<double, kLoudness> loudest_{};
};

/// The pulse that a listener would tap, at the end of what was heard.
struct Pulse {
  double next = 0;        ///< rows from the last one heard to the next beat, in (0, period]
  double period = 0;      ///< rows from beat to beat; 0: none was found
  double confidence = 0;  ///< 0 to 1: how well beats told a second ahead met onsets

  /// Whether to move to it. Random onsets stay below.
  bool Certain() const;
};

/// Rows that a pulse is heard in: 12 s.
inline constexpr int kPulseMemory = 360;

/// The predominant pulse of the last kPulseMemory of `onsets` (RowOnset, one a row, oldest first),
/// between 60 and 200 beats a minute: a bank of damped resonators, one for each tempo and its
/// double and fourfold, says tempo and phase; a hypothesis is kept until another one has been
/// clearly better for a second. A pure function.
Pulse HearPulse(std::span<const float> onsets);

}  // namespace choreo
