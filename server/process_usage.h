#pragma once

#include <sys/types.h>

#include <cstdint>

/// What a process on this machine has used. Throws Error(kNotFound) where it is gone.
namespace choreo {

double CpuSeconds(pid_t process);
int64_t ResidentBytes(pid_t process);
int64_t VirtualBytes(pid_t process);
int64_t Threads(pid_t process);
int64_t Descriptors(pid_t process);  ///< that are open
double StartSeconds(pid_t process);  ///< when it began, since 1970, to a second or so

}  // namespace choreo
