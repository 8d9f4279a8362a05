#pragma once

#include <string>

namespace choreo {

/// Formats a measured number for messages: two decimals, or two significant digits below 0.1,
/// without trailing zeros; "0" below half a thousandth.
std::string Rounded(double value);

/// Formats a measured number that exceeds `limit`: like Rounded, or like InFull if rounding would
/// make it equal the limit.
std::string RoundedBeyond(double value, double limit);

/// Formats a number exactly: a refused value might look allowed when rounded.
std::string InFull(double value);

}  // namespace choreo
