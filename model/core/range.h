#pragma once

#include <string>

#include "model/core/error.h"
#include "model/core/rounded.h"

namespace choreo {

/// The numbers that a value may be, both ends included.
struct Range {
  double least = 0, most = 1;

  /// Throws Error(kInvalidArgument) for `field` unless `value` is one of them; NaN never is.
  void Check(double value, const std::string& field) const {
    if (value >= least && value <= most) return;
    throw InvalidArgument(
        field, InFull(value) + " is not in [" + InFull(least) + ", " + InFull(most) + "]");
  }
};

}  // namespace choreo
