#pragma once

#include "model/audio/mel.h"

namespace choreo {

/// What a row of a FeatureStream sounds like, besides its MFCC. Powers are mean squares of its
/// window; a sine of full scale has 0.5.
struct RowSound {
  float onset = 0;  ///< RowOnset's
  float power = 0;  ///< weighted as ITU-R BS.1770 does (K), so that it says how loud it is
  float bass = 0;   ///< the power below 130 Hz, unweighted
};

/// The powers of a row whose bands are these; its onset is left out.
RowSound PowersOf(const MelBandsDb& db);

/// LUFS of the mean of some rows' power.
double Loudness(double power);

}  // namespace choreo
