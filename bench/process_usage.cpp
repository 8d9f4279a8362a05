#include "bench/process_usage.h"

#include <unistd.h>

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

}  // namespace

double CpuSeconds(pid_t process) {
  const std::string stat = Read(process, "stat");
  // The program's name, in brackets, may hold spaces; user and system time are fields 14 and 15.
  std::istringstream fields(stat.substr(stat.rfind(')') + 2));
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

int64_t ResidentBytes(pid_t process) {
  std::istringstream pages(Read(process, "statm"));
  int64_t total = 0, resident = 0;
  pages >> total >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

}  // namespace choreo::bench
