#pragma once

#include "model/core/error.h"
#include "model/core/rounded.h"

namespace choreo {

/// Throws Error(kInvalidArgument, `field`) unless low <= value <= high.
inline void CheckWithin(const char* field, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw InvalidArgument(field,
                          InFull(value) + ", must be " + InFull(low) + " to " + InFull(high));
}

}  // namespace choreo
