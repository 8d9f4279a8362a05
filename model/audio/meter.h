#pragma once

namespace choreo {

/// Bars of four beats, of three, or of two with three eighths each.
enum class Meter { kFour, kThree, kSix };

}  // namespace choreo
