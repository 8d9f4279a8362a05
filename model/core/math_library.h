#pragma once

#include <string>

namespace choreo {

/// The C library whose sin, exp, ... this process runs, and which of their variants it takes on
/// this CPU, as in "glibc 2.36 fma": another one may round another way.
std::string MathLibrary();

}  // namespace choreo
