#pragma once

#include <string>

namespace choreo {

/// Names the C library that computes sin, exp, ... in this process, and the variant that it selects
/// for this CPU, such as "glibc 2.36 fma". Other libraries and variants may round differently.
std::string MathLibrary();

}  // namespace choreo
