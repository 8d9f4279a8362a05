#pragma once

namespace choreo {

/// A bar has four beats, three, or two of three eighths each.
enum class Meter { kFour, kThree, kSix };

}  // namespace choreo
