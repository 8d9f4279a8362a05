#pragma once

#include <sys/types.h>

#include <cstdint>

/// The resources that a process on this machine uses. Each function throws Error(kNotFound) if the
/// process has ended.
namespace choreo {

double CpuSeconds(pid_t process);
int64_t ResidentBytes(pid_t process);
int64_t VirtualBytes(pid_t process);
int64_t Threads(pid_t process);
int64_t Descriptors(pid_t process);  ///< open file descriptors
double StartSeconds(pid_t process);  ///< start time in seconds since 1970, to about a second

}  // namespace choreo
