#pragma once

#include <array>

#include "model/audio/beats/onset.h"
#include "model/audio/music/row_onset.h"
#include "model/audio/signal/mel.h"

namespace choreo {

/// Onset frames per row; the first has the row's centre.
inline constexpr int kRowOnsets = kFeatureHop / kOnsetHop;
static_assert(kRowOnsets * kOnsetHop == kFeatureHop);
/// The largest number of earlier rows on which a row's onsets depend.
inline constexpr int kRowSoundMemory = RowOnset::kMemory;
static_assert(OnsetMeter::kMemory <= kRowOnsets * kRowSoundMemory);

/// The sound of a FeatureStream's row. Powers are mean squares over its window, without a DC
/// offset, which nobody hears; a full-scale sine has 0.5.
struct RowSound {
  float onset = 0;                         ///< from RowOnset
  std::array<Onset, kRowOnsets> onsets{};  ///< from OnsetMeter, oldest first
  float power = 0;                         ///< K-weighted as in ITU-R BS.1770: its loudness
  float bass = 0;                          ///< the power below 130 Hz, unweighted
};

/// The powers of a row with these bands, without its onset.
RowSound PowersOf(const MelBandsDb& db);

/// Converts a mean power of rows to LUFS.
double Loudness(double power);

}  // namespace choreo
