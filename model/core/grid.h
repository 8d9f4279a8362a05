#pragma once

/// The grid that motion and music share: frame n of a dance and row n of its music are at second n
/// / kModelFps.
namespace choreo {

inline constexpr double kModelFps = 30;    ///< frames, and music rows, per second
inline constexpr int kHistoryFrames = 10;  ///< tau: past poses that a model sees
inline constexpr int kMfccCount = 40;      ///< coefficients in a row of music
inline constexpr int kTypicalFrames = 60;  ///< between keys: 2 s

}  // namespace choreo
