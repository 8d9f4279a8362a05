#pragma once

namespace choreo {

/// The largest hit of a key. A hit is the speed of arrival over the dance's own: 0 eases into the
/// key, 1 keeps the timing, and larger values arrive late and fast. From 4 on, time would run
/// backwards (HitTime).
inline constexpr double kMaxHit = 3;

}  // namespace choreo
