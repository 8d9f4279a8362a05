#pragma once

#include <cstdint>

namespace choreo::bench {

/// Prints the rises for BarPatterns(), measured on `songs` synthetic songs of each pattern.
void PrintBarPatterns(uint64_t first_seed, int songs);

}  // namespace choreo::bench
