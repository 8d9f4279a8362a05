#pragma once

/// What motion and music agree on: frame n of a dance, and row n of its music, are at second
/// n / kModelFps.
namespace choreo {

inline constexpr double kModelFps = 30;    ///< frames, and rows of music, a second
inline constexpr int kHistoryFrames = 10;  ///< tau, past poses that a model sees
inline constexpr int kMfccCount = 40;      ///< coefficients of a row of music
inline constexpr int kUsualFrames = 60;    ///< from one key to the next: 2 s

}  // namespace choreo
