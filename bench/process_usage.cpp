#include "bench/process_usage.h"

#include <time.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "model/core/error.h"

namespace choreo::bench {
namespace {

std::string Read(pid_t process, const char* name) {
  const std::string path = "/proc/" + std::to_string(process) + "/" + name;
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  if (text.str().empty()) throw Error(ErrorCode::kNotFound, path, "the process is gone");
  return text.str();
}

int64_t EntriesOf(pid_t process, const char* folder) {
  const auto path = std::filesystem::path("/proc") / std::to_string(process) / folder;
  std::error_code error;
  const std::filesystem::directory_iterator entries(path, error);
  if (error) throw Error(ErrorCode::kNotFound, path.string(), "the process is gone");
  return std::distance(begin(entries), end(entries));
}

}  // namespace

double CpuSeconds(pid_t process) {
  // In nanoseconds; /proc counts in hundredths of a second.
  clockid_t clock = 0;
  timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0)
    throw Error(ErrorCode::kNotFound, std::to_string(process), "the process is gone");
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

int64_t ResidentBytes(pid_t process) {
  std::istringstream pages(Read(process, "statm"));
  int64_t total = 0, resident = 0;
  pages >> total >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

int64_t Threads(pid_t process) { return EntriesOf(process, "task"); }

int64_t Descriptors(pid_t process) { return EntriesOf(process, "fd"); }

}  // namespace choreo::bench
