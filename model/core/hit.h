#pragma once

namespace choreo {

/// How hard a key may be hit: 0 settles into it gently, 1 takes the dance's own time, this one
/// comes late and fast. From 4 on time would run backwards.
inline constexpr double kMaxHit = 3;

}  // namespace choreo
