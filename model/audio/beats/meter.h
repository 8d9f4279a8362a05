#pragma once

namespace choreo {

/// The metre: bars of four beats, of three, or of two with three eighths each.
enum class Meter { kFour, kThree, kSix };

}  // namespace choreo
