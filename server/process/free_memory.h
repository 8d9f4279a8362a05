#pragma once

#include <cstdint>

namespace choreo {

/// Returns freed memory to the system. The C library keeps free memory that lies between blocks in
/// use: after a flood of calls, more than a GiB. Not thread-safe.
class FreeMemory {
 public:
  /// Call regularly. Returns memory only if at least kMuch is free, because allocations of other
  /// threads wait meanwhile.
  void Look();

  static constexpr int64_t kMuch = int64_t{256} << 20;

 private:
  int64_t least_ = INT64_MAX;  // the fewest resident bytes since memory was last returned
};

}  // namespace choreo
