#include "server/process/free_memory.h"

#include <malloc.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>

#include "server/process/process_usage.h"

namespace choreo {

// Counts free memory only after resident memory has grown, because counting takes time, too.
void FreeMemory::Look() {
  const int64_t resident = ResidentBytes(getpid());
  least_ = std::min(least_, resident);
  if (resident - least_ < kMuch || static_cast<int64_t>(mallinfo2().fordblks) < kMuch) return;
  malloc_trim(0);
  least_ = ResidentBytes(getpid());
  spdlog::info("{} MiB of free memory given back", (resident - least_) >> 20);
}

}  // namespace choreo
