#pragma once

/// The time grid that motion and music share: frame n of a dance and row n of its music are at n /
/// kModelFps seconds.
namespace choreo {

inline constexpr double kModelFps = 30;    ///< frames and music rows per second
inline constexpr int kHistoryFrames = 10;  ///< tau in paper F: past poses that a model sees
inline constexpr int kMfccCount = 40;      ///< coefficients in a row of music
inline constexpr int kTypicalFrames = 60;  ///< typical distance between keys: 2 s

}  // namespace choreo
