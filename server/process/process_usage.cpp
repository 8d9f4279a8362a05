#include "server/process/process_usage.h"

#include <time.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "model/core/error.h"

namespace choreo {
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

/// Pages of memory: total and resident.
std::pair<int64_t, int64_t> PagesOf(pid_t process) {
  std::istringstream text(Read(process, "statm"));
  std::pair<int64_t, int64_t> pages;
  text >> pages.first >> pages.second;
  return pages;
}

}  // namespace

double CpuSeconds(pid_t process) {
  // Has nanoseconds; /proc has hundredths of a second.
  clockid_t clock = 0;
  timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0)
    throw Error(ErrorCode::kNotFound, std::to_string(process), "the process is gone");
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

int64_t VirtualBytes(pid_t process) { return PagesOf(process).first * sysconf(_SC_PAGESIZE); }

int64_t ResidentBytes(pid_t process) { return PagesOf(process).second * sysconf(_SC_PAGESIZE); }

int64_t Threads(pid_t process) { return EntriesOf(process, "task"); }

int64_t Descriptors(pid_t process) { return EntriesOf(process, "fd"); }

double StartSeconds(pid_t process) {
  // The 22nd field is the start time, counted from boot; the 2nd, a name in brackets, may contain
  // blanks.
  const std::string stat = Read(process, "stat");
  std::istringstream fields(stat.substr(stat.rfind(')') + 1));
  std::string skipped;
  for (int field = 3; field < 22; ++field) fields >> skipped;
  double ticks = 0;
  fields >> ticks;
  timespec now{}, since_start{};
  clock_gettime(CLOCK_REALTIME, &now);
  clock_gettime(CLOCK_BOOTTIME, &since_start);
  return static_cast<double>(now.tv_sec - since_start.tv_sec) +
         ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace choreo
