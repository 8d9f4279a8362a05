#pragma once

namespace choreo {

/// The largest hit of a key. A hit is the speed of arrival over the dance's own: 0 eases into the
/// key, 1 keeps the timing, and larger values arrive late and fast. From 4 on, time would run
/// backwards (HitTime).
inline constexpr double kMaxHit = 3;

/// The time before a key that its hit affects, in seconds. 0.5 would be too short, because Arrival
/// smooths the last 0.4 s.
inline constexpr double kHitSeconds = 0.8;

}  // namespace choreo
