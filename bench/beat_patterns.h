#pragma once

#include <cstdint>

namespace choreo::bench {

/// Prints the rises of BarPatterns() as they are in made songs, so many of each pattern.
void PrintBarPatterns(uint64_t first_seed, int songs);

}  // namespace choreo::bench
