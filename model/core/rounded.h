#pragma once

#include <string>

namespace choreo {

/// A measured number for messages: two decimals, or two significant digits below 0.1; no trailing
/// zeros; 0 below half a thousandth.
std::string Rounded(double value);

/// A measured number that exceeds `limit`: rounded as above, or in full if rounding would make it
/// look like the limit.
std::string RoundedBeyond(double value, double limit);

/// A number in full: for refused values and limits, which might look allowed when rounded.
std::string InFull(double value);

}  // namespace choreo
