#pragma once

#include <sys/types.h>

#include <cstdint>

/// Resources used by a process on this machine. Throws Error(kNotFound) if it has ended.
namespace choreo {

double CpuSeconds(pid_t process);
int64_t ResidentBytes(pid_t process);
int64_t VirtualBytes(pid_t process);
int64_t Threads(pid_t process);
int64_t Descriptors(pid_t process);  ///< that are open
double StartSeconds(pid_t process);  ///< its start since 1970, to about a second

}  // namespace choreo
