#pragma once

#include <string>

namespace choreo {

/// The C library whose sin, exp, ... this process calls, and the variant that it selects on this
/// CPU, e.g. "glibc 2.36 fma". Other libraries and variants may round differently.
std::string MathLibrary();

}  // namespace choreo
