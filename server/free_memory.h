#pragma once

#include <cstdint>

namespace choreo {

/// Gives memory back that has been freed but is still the process's: the C library keeps what lies
/// between pieces in use, and after a flood of calls that is more than a GiB. For one thread.
class FreeMemory {
 public:
  /// Call regularly. Others who allocate wait meanwhile, so it acts where much is free alone.
  void Look();

  static constexpr int64_t kMuch = int64_t{256} << 20;

 private:
  int64_t least_ = INT64_MAX;  // bytes that were resident since it last gave some back
};

}  // namespace choreo
