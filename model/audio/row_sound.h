#pragma once

#include "model/audio/mel.h"

namespace choreo {

/// The sound of a FeatureStream's row, besides its MFCC. Powers are mean squares over its window; a
/// full-scale sine has 0.5.
struct RowSound {
  float onset = 0;  ///< from RowOnset
  float power = 0;  ///< K-weighted as in ITU-R BS.1770: its loudness
  float bass = 0;   ///< the power below 130 Hz, unweighted
};

/// The powers of a row with these bands, without its onset.
RowSound PowersOf(const MelBandsDb& db);

/// LUFS of a mean power of rows.
double Loudness(double power);

}  // namespace choreo
