#pragma once

namespace choreo {

/// Tempi that differ by less than this share, a semitone's, are one.
inline constexpr double kSameTempo = 0.06;

}  // namespace choreo
