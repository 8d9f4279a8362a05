#pragma once

namespace choreo {

/// The largest hit of a key. Hit 0 eases into the key, 1 keeps the dance's own timing, and larger
/// values arrive late and fast. From 4 on, time would run backwards.
inline constexpr double kMaxHit = 3;

}  // namespace choreo
