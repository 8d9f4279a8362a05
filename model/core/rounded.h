#pragma once

#include <string>

namespace choreo {

/// A measured number as messages show it to people: to hundredths or, below a tenth, to two
/// significant digits; without trailing zeros. (What is refused is shown in full: rounded it might
/// look allowed.)
std::string Rounded(double value);

}  // namespace choreo
