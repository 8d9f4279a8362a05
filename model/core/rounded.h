#pragma once

#include <string>

namespace choreo {

/// A measured number as messages show it to people: to hundredths or, below a tenth, to two
/// significant digits; without trailing zeros, and 0 below half a thousandth.
std::string Rounded(double value);

/// A measured number beside the limit that it is beyond: as above, or with all its digits where
/// that would look like the limit itself.
std::string RoundedBeyond(double value, double limit);

/// A number with all its digits: what is refused, and its limit. Rounded it might look allowed.
std::string InFull(double value);

}  // namespace choreo
